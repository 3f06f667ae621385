"""Radau's collocation: stages, and polynomials through them."""

import numpy as np
from numpy.polynomial import legendre, Legendre


class Radau:
    """Radau IIA with `s` stages: order 2 s - 1 at the end of a step, s within it."""

    def __init__(self, s):
        self.s = s
        # The stages are the roots of P_s - P_{s-1} on [-1, 1], of which 1 is the last.
        roots = Legendre.basis(s) - Legendre.basis(s - 1)
        x = np.sort(np.real(roots.roots()))
        for _ in range(3):
            x = x - roots(x) / roots.deriv()(x)
        x[-1] = 1.0
        self.c = (x + 1) / 2
        self.to_coefficients = np.linalg.inv(legendre.legvander(x, s - 1))
        unit = np.eye(s)
        first = np.stack([legendre.legint(own, lbnd=-1) / 2 for own in unit], axis=-1)
        second = np.stack([legendre.legint(own, m=2, lbnd=-1) / 4 for own in unit], axis=-1)
        self.first, self.second = first @ self.to_coefficients, second @ self.to_coefficients
        _, self.A, self.AA = self.all(self.c)

    def all(self, theta):
        """Values of the stages' polynomials, their integrals from 0, and the integrals of those."""
        powers = legendre.legvander(2 * np.asarray(theta) - 1, self.s + 1)
        return powers[:, :-2] @ self.to_coefficients, powers[:, :-1] @ self.first, powers @ self.second
