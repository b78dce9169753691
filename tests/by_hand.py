"""What tests calculate by hand in several rooms, without anything of the product."""

import math
import re

# of a fender's reaction: manufacture, ageing, velocity, repetition, temperature; SR179 report (1982), chapter 3.4
SOFTEST, STIFFEST = 0.9 * 1.0 * 1.0 * 0.8 * 0.95, 1.1 * 1.05 * 1.1 * 0.9 * 1.25


def root(value, low, high):
    """Where a rising function is zero"""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if value(middle) < 0 else (low, middle)
    return middle


def span_of(H, weight, length, height):
    """m between the ends of an inextensible chain partly on the bed: s = √(h(h + 2a)) hangs, L − s + a arcosh(1 + h/a)

    H : N, horizontal; weight : N/m in water; length, height : m; a = H/w
    """
    a = H / weight
    return length - math.sqrt(height * (height + 2 * a)) + a * math.acosh(1 + height / a)


def numbers(text):
    return [float(word) for word in re.findall(r"-?\d+\.?\d*(?:e[+-]?\d+)?", text)]


def line_of(said, words):
    return next(line for line in said.splitlines() if words in line)
