"""Steering logs in, runs out and in again."""
