"""Pull of a moving line during a step of the body: Legendre polynomials."""

from hakobune.bem.kernels.jit import kernel

TERMS = 4  # terms of the polynomial of a line's tension during a step of the body


@kernel(inline=True)
def legendre(x, out):
    """P₀ … P₃ at x, into out (4,)"""
    out[0], out[1], out[2], out[3] = 1.0, x, 1.5 * x * x - 0.5, x * (2.5 * x * x - 1.5)
