"""Range in which a truck follows a linear model."""

LINEAR_LATERAL_ACCELERATION = 4.0
"""Lateral acceleration beyond which the tyres of a loaded truck saturate and it may roll over [m/s^2]."""
LINEAR_ARTICULATION = 0.2
"""Angle at which the sine differs from the angle by 0.7 %, and the cosine from 1 by 2 % [rad]."""
