"""Spectra of relaxation times as estimators of the shape that scikit-learn has: ``fit``, ``predict``, ``score``.

    spectrum = RelaxationSpectrum(error=0.01).fit(t, E)      # s, Pa
    spectrum.spring_, spectrum.times_, spectrum.strengths_   # Pa, s, Pa
    spectrum.floor_    # how near any network of springs and dashpots comes, relative
"""

from __future__ import annotations

import csv
import inspect
import os
import tempfile
from typing import Any

import numpy as np

from ._verbs import Result, fit


class _Spectrum:
    """What both kinds of data share: parameters, and what is found."""

    _columns: tuple[str, ...]

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The parameters of the estimator by name."""
        return {name: getattr(self, name) for name in inspect.signature(type(self)).parameters}

    def set_params(self, **parameters: Any) -> Any:
        """Changes parameters of the estimator; itself."""
        for name, value in parameters.items():
            if name not in self.get_params():
                raise ValueError(f"{type(self).__name__} has no parameter {name!r}")
            setattr(self, name, value)
        return self

    def _found(self, first: Any, *moduli: Any) -> Any:
        columns = [np.asarray(own, dtype=float).ravel() for own in (first, *moduli)]
        header, *words = self._columns
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "measured.csv")
            with open(path, "w", newline="", encoding="utf-8") as file:
                rows = csv.writer(file)
                rows.writerow([header, *(f"{word} [Pa]" for word in words)])
                rows.writerows([repr(float(value)) for value in row] for row in zip(*columns, strict=True))
            self.result_: Result = fit(to=f"{path}:{','.join(words)}=m", error=repr(float(self.error)))
        branches = self.result_["branches"]
        self.times_ = np.array([own["time"] for own in branches])
        self.strengths_ = np.array([own["strength"] for own in branches])
        self.spring_ = float(self.result_["spring"])
        self.dashpot_ = float(self.result_["dashpot_constant"])
        self.floor_ = float(self.result_["floor"])
        self.n_features_in_ = 1
        return self

    def __sklearn_tags__(self) -> Any:
        from sklearn.utils import InputTags, RegressorTags, Tags, TargetTags

        target = TargetTags(required=True)
        return Tags("regressor", target, regressor_tags=RegressorTags(), input_tags=InputTags())

    def __repr__(self) -> str:
        own = ", ".join(f"{name}={value!r}" for name, value in self.get_params().items())
        return f"{type(self).__name__}({own})"


class RelaxationSpectrum(_Spectrum):
    """E(t) = E∞ + Σ E_i exp(−t/τ_i) with the fewest branches that keep an error; nothing is negative.

    Args:
        error: the largest relative error that fewer branches may make.

    After ``fit``: ``spring_`` E∞ and ``strengths_`` E_i in Pa, ``times_`` τ_i in s, ``floor_``, the relative rms that
    no network of springs and dashpots is below, and ``result_``, all that ``dashpot fit --json`` tells.
    """

    _columns = ("t [s]", "E_relax")

    def __init__(self, error: float = 0.01) -> None:
        self.error = error

    def fit(self, t: Any, modulus: Any) -> RelaxationSpectrum:
        """Fits to a relaxation modulus in Pa at times in s, of shape (n,) or (n, 1); itself."""
        return self._found(t, modulus)

    def predict(self, t: Any) -> np.ndarray:
        """The modulus in Pa at times in s."""
        own = np.asarray(t, dtype=float).ravel()
        return self.spring_ + np.exp(-own[:, None] / self.times_) @ self.strengths_

    def score(self, t: Any, modulus: Any) -> float:
        """Minus the relative rms of the deviation; 0 is perfect."""
        return -float(np.sqrt(np.mean((self.predict(t) / np.ravel(modulus) - 1.0) ** 2)))


class DynamicSpectrum(_Spectrum):
    """The same from storage and loss modulus over the frequency, as a DMA measures them.

    Args:
        error: the largest relative error that fewer branches may make.
    """

    _columns = ("f [Hz]", "E_stor", "E_loss")

    def __init__(self, error: float = 0.01) -> None:
        self.error = error

    def fit(self, frequency: Any, modulus: Any) -> DynamicSpectrum:
        """Fits to a complex modulus in Pa at frequencies in Hz, complex or of shape (n, 2); itself."""
        own = np.asarray(modulus)
        storage, loss = (own.real, own.imag) if np.iscomplexobj(own) else own.T
        return self._found(frequency, storage, loss)

    def predict(self, frequency: Any) -> np.ndarray:
        """The complex modulus in Pa at frequencies in Hz."""
        s = 2j * np.pi * np.asarray(frequency, dtype=float).ravel()
        branches = (s[:, None] * self.times_ / (1.0 + s[:, None] * self.times_)) @ self.strengths_
        return self.spring_ + s * self.dashpot_ + branches

    def score(self, frequency: Any, modulus: Any) -> float:
        """Minus the relative rms of the deviation of the complex modulus; 0 is perfect."""
        own = np.asarray(modulus)
        own = own if np.iscomplexobj(own) else own[:, 0] + 1j * own[:, 1]
        return -float(np.sqrt(np.mean(np.abs(self.predict(frequency) / own - 1.0) ** 2)))
