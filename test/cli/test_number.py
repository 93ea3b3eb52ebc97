from yawdamp_ros.cli.number import number


def test_rounding_noise_is_zero_and_zero_has_no_sign() -> None:
    assert [number(value) for value in (4.4e-10, -1e-17, 1.5e-9, float("nan"))] == [
        "0",
        "0",
        "1.5e-09",
        "nan",
    ]
    assert [number(value, ".3f") for value in (-0.0004, -1e-12, 1.0)] == ["0.000", "0.000", "1.000"]
