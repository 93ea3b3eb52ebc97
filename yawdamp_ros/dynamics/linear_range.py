"""Range in which a truck follows a linear model."""

LINEAR_LATERAL_ACCELERATION = 4.0
"""In m/s^2. Beyond about this, the tyres of a loaded truck saturate and it may roll over."""
LINEAR_ARTICULATION = 0.2
"""In rad, at which the sine and the angle differ by 0.7 %, and the cosine from 1 by 2 %."""
