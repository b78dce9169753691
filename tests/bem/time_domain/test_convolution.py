"""Convolution with a retardation function against what it is exactly, and against the states of `memory`."""

import numpy as np
import pytest
from retardation import Retardation, convolution, history_weights

LIMIT = np.zeros((6, 6))


def decaying(step, last=60.0):
    times = np.arange(0, last + step / 2, step)
    return Retardation(times, np.multiply.outer(np.exp(-0.5 * times), np.eye(6)), LIMIT)


def exact(times):
    """∫ exp(−½τ) ν(t − τ) dτ of ν = sin² t"""
    part = 0.5 * np.cos(2 * times) + 2 * np.sin(2 * times)
    return 0.5 * (2 - (part / (0.25 + 4)) - (2 - 0.5 / 4.25) * np.exp(-0.5 * times))


def test_convolution_converges_at_second_order():
    errors = []
    for step in (0.2, 0.1, 0.05):
        times = np.arange(0, 30, step)
        velocity = np.sin(times)[:, None] ** 2 * np.eye(6)[0]
        errors.append(np.abs(convolution(decaying(step), velocity)[:, 0] - exact(times)).max())
    assert np.all(np.log2(np.divide(errors[:-1], errors[1:])) > 1.95), errors


def test_a_step_of_convolution_is_the_sum_over_the_history():
    memory = decaying(0.1, 5.0)
    velocity = np.random.default_rng(2).standard_normal((200, 6))
    weights = history_weights(memory)
    now = np.einsum("jik,jk->i", weights, velocity[::-1][: len(weights)])
    assert convolution(memory, velocity)[-1] == pytest.approx(now, abs=1e-12)
