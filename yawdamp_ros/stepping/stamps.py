"""Time stamps of steps."""


class Stamps:
    """Stamps on the grid of steps, brought back to a clock by whole jumps.

    Parameters
    ----------
    step_ns : int
        Step size [ns].
    start : int
        Stamp of step 0 [ns].

    Examples
    --------
    >>> stamps = Stamps(1_000_000, 0)
    >>> stamps.of(5)
    5000000
    >>> stamps.follow(10, clock=3_010_000_000, tolerance=10_000_000)
    3000000000
    >>> stamps.of(10)
    3010000000
    """

    def __init__(self, step_ns: int, start: int) -> None:
        self._step_ns = step_ns
        self._offset = start

    def of(self, step: int) -> int:
        """Stamp of a step [ns]."""
        return self._offset + step * self._step_ns

    def at(self, stamp: int) -> int:
        """Step of a stamp [ns]."""
        return (stamp - self._offset) // self._step_ns

    def jump(self, nanoseconds: int) -> None:
        """Shift the stamps of all steps from now on."""
        self._offset += nanoseconds

    def follow(self, step: int, clock: int, tolerance: int) -> int:
        """Jump to a clock if a step's stamp is too far from it.

        Parameters
        ----------
        step : int
        clock : int
            Time of the clock at that step [ns].
        tolerance : int
            Largest difference that causes no jump [ns].

        Returns
        -------
        int
            The jump [ns]; 0 if there is none.
        """
        difference = clock - self.of(step)
        if abs(difference) <= tolerance:
            return 0
        self.jump(difference)
        return difference
