"""A system of polynomials in a file, and the report of its decision."""
