"""Modes, measures and sweeps: arrays in, small result types out."""
