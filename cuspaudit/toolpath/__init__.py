"""Tool paths: what becomes of every posture of the first pose.

`trace.trace_path` follows a path from all postures, `starts.solve_pose` finds those of
one pose; `reading` reads the files. Geometry first: the postures and parameters with
the tip on a leg are a curve (`leg_system`), covered by proved tubes (`tube`, `strand`),
cut into runs (`runs`) and, where joints have limits, shortened (`limits`).
"""
