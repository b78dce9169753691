"""Random numbers for bodies, and what the scripts that draw bodies are asked."""

import argparse

import numpy as np


def between(rng, low, high):
    """A number whose logarithm is spread evenly"""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def asked(words, about, quick, bodies, seed):
    """Arguments of a script: quick, bodies, seed; `quick` says what --quick does"""
    parser = argparse.ArgumentParser(description=about.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help=quick)
    parser.add_argument("--bodies", type=int, default=bodies)
    parser.add_argument("--seed", type=int, default=seed)
    return parser.parse_args(words)
