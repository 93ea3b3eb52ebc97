"""Settings of the nonlinear model that are no property of a vehicle."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Settings:
    """Parts of the model that are active, and its speed controller.

    Attributes
    ----------
    track : bool
        Whether wheels stand apart; without it both wheels of an axle stand in its middle (single track).
    roll : bool
        Whether units roll; needs the track.
    load_shift : bool
        Whether braking and driving shift load between axles.
    relaxation : bool
        Whether tyre forces lag behind the slip. Without it the model is not fit for standstill.
    rolling_resistance, drag : bool
        Whether these resist the motion.
    speed_gain : float
        Gain of the speed controller: acceleration demanded per speed error [1/s]. The driven axles both drive
        and retard, as a cruise control with a retarder does.
    lowest_demand, highest_demand : float
        Limits of that acceleration [m/s^2].
    load_shift_time : float
        Time constant by which load follows longitudinal acceleration, that of pitching [s].
    rollover_angle : float
        Roll angle from which no unit comes back; the run ends there [rad].
    swing_angle : float
        Side slip angle at the middle of a trailer's axles from which it swings [rad].

    Examples
    --------
    >>> from yawdamp_ros.nonlinear import Settings
    >>> Settings(roll=False).track
    True
    """

    track: bool = True
    roll: bool = True
    load_shift: bool = True
    relaxation: bool = True
    rolling_resistance: bool = True
    drag: bool = True
    speed_gain: float = 5.0
    lowest_demand: float = -2.0
    highest_demand: float = 2.0
    load_shift_time: float = 0.1
    rollover_angle: float = 0.785
    swing_angle: float = 0.2
