"""Spectra: what is known is found again."""

import numpy as np
import pytest

from dashpot.spectra import DynamicSpectrum, RelaxationSpectrum

SPRING, TIMES, STRENGTHS = 2e6, np.array([1e-3, 1e-1, 10.0]), np.array([8e6, 4e6, 1e6])


def relaxation(t):
    return SPRING + np.exp(-t[:, None] / TIMES) @ STRENGTHS


def test_a_relaxation_modulus_is_found_again():
    t = np.geomspace(1e-5, 1e3, 121)
    own = RelaxationSpectrum(error=1e-3).fit(t, relaxation(t))
    assert abs(own.spring_ / SPRING - 1.0) < 1e-3 and own.floor_ < 1e-3
    assert np.abs(own.predict(t) / relaxation(t) - 1.0).max() < 1.1e-3
    assert own.score(t, relaxation(t)) > -1e-3 and (own.strengths_ >= 0.0).all()


def test_a_complex_modulus_is_found_again():
    f = np.geomspace(1e-4, 1e5, 121)
    s = 2j * np.pi * f
    modulus = SPRING + (s[:, None] * TIMES / (1.0 + s[:, None] * TIMES)) @ STRENGTHS
    own = DynamicSpectrum(error=1e-3).fit(f, modulus)
    assert own.score(f, modulus) > -1.5e-3
    pairs = np.column_stack([modulus.real, modulus.imag])
    assert own.score(f, pairs) == own.score(f, modulus)


def test_it_is_an_estimator():
    own = RelaxationSpectrum()
    assert own.set_params(error=0.05).get_params() == {"error": 0.05}
    with pytest.raises(ValueError, match="erorr"):
        own.set_params(erorr=1.0)
    base = pytest.importorskip("sklearn.base")
    assert base.clone(own).error == 0.05
    assert base.is_regressor(own)
