"""The polynomial map of a robot, its postures, and the theorems about its axes."""

from cuspaudit.kinematics.determinant import jacobian_determinant
from cuspaudit.kinematics.exact_model import ExactModel, exact_model
from cuspaudit.kinematics.polynomial_map import polynomial_map

__all__ = ["ExactModel", "exact_model", "jacobian_determinant", "polynomial_map"]
