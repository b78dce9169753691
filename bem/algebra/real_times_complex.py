"""Products of a real and a complex matrix as one real product.

numpy would convert both matrices to complex, which takes twice the work."""

import numpy as np


def real_times_complex(real, values):
    """Product of a real (…, a, b) and a complex (…, b, c) array of matrices"""
    return (real @ np.ascontiguousarray(values).view(float)).view(complex)


def complex_times_real(values, real):
    """Product of a complex (…, a, b) and a real (…, b, c) array of matrices"""
    both = np.concatenate([values.real, values.imag], axis=-2) @ real
    half = both.shape[-2] // 2
    out = np.empty((*both.shape[:-2], half, both.shape[-1]), complex)
    out.real, out.imag = both[..., :half, :], both[..., half:, :]
    return out
