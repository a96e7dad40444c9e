"""The live translator, block by block."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _native
from ._arguments import checked, meant
from ._arrays import FloatArray, as_rate, as_sound
from ._errors import Error
from ._parameters import LIVE, checked_options
from ._profile import AnyProfile, Profile, as_profile
from ._sound import AnySettings, settings_text
from ._warnings import warn


class Translator:
    """Translates mono sound to touch block by block, as the plugin does.

    The drive comes :attr:`latency` frames after the sound. Pickling keeps set-up and parameters, not what was heard.

    Parameters
    ----------
    sample_rate : float, default 48000
        8000 to 768000 Hz.
    profile : Profile, str or path, optional
        The actuator; without it the drive is flat.
    bands : int, default 6
        Number of bands, 1 to 12.
    max_boost, strength : float
        As of :func:`render`.
    preset : str, optional
        Name of one of :meth:`presets`.
    settings : path or mapping, optional
        A settings file with the part ``live``, as the plugin saves presets and ``pacini live --settings`` reads them,
        or its content. Not beside a preset.
    **params
        Parameters of the plugin, by the names in :attr:`params`; they override preset and settings.

    Raises
    ------
    Error
        A parameter is out of its range, or the settings cannot be read or have no part ``live``.
    """

    @checked
    def __init__(
        self,
        sample_rate: float = 48000,
        *,
        profile: Optional[AnyProfile] = None,
        bands: int = 6,
        max_boost: float = 6.0,
        strength: float = _native.STANDARD_STRENGTH,
        preset: Optional[str] = None,
        settings: Optional[AnySettings] = None,
        **params: Any,
    ) -> None:
        if preset is not None and settings is not None:
            raise Error("and settings exclude each other; leave one of them out", "preset", "invalidArgument")
        self.sample_rate = as_rate(sample_rate)
        self.profile: Optional[Profile] = None if profile is None else as_profile(profile)
        self._setup = (bands, max_boost, strength)
        self._handle = _native.TranslatorHandle(
            float(self.sample_rate),
            None if self.profile is None else self.profile._handle,
            {"bands": bands, "max_boost": max_boost, "strength": strength},
        )
        if preset is not None:
            known = self.presets()
            if preset not in known:
                raise Error(f"'{preset}' is not one of {', '.join(known)}{meant(preset, known)}", "preset")
            self.set(**known[preset])
        if settings is not None:
            live, doubts = _native.translator_settings(settings_text(settings))
            for doubt in doubts:
                warn(f"settings: {doubt}")
            self.set(**live)
        if params:
            self.set(**params)
        self._handle.reset()

    @staticmethod
    @checked
    def presets() -> dict[str, dict[str, Any]]:
        """Parameters by the names of the presets of the plugin."""
        return dict(_native.translator_presets())

    @property
    def params(self) -> dict[str, Any]:
        """The parameters and their values; :meth:`set` changes them."""
        return self._handle.params()

    @checked
    def set(self, **params: Any) -> None:
        """Changes parameters smoothly; right after :meth:`reset` at once.

        Parameters
        ----------
        **params
            By the names in :attr:`params`.

        Raises
        ------
        Error
            A value is out of its range.
        """
        self._handle.set_params(checked_options("Translator", params, LIVE))

    @checked
    def process(self, block: FloatArray) -> npt.NDArray[np.float32]:
        """Translates the next block.

        Parameters
        ----------
        block : array of float32 or float64, (frames,)
            Mono sound of any length. Samples that are not finite count as silence.

        Returns
        -------
        array of float32, (frames,)
            The drive, as many frames.
        """
        sound = as_sound(block, -1, "block")
        if sound.ndim != 1:
            raise Error("must be mono: (frames,)", "block")
        return np.asarray(self._handle.process(sound), np.float32)

    __call__ = process

    @checked
    def reset(self) -> None:
        """Resets the translator to its initial state."""
        self._handle.reset()

    @property
    def latency(self) -> int:
        """Delay of the drive against the sound, frames."""
        return self._handle.latency

    @property
    def meters(self) -> dict[str, Any]:
        """Levels of the last block."""
        return self._handle.meters()

    @property
    def savings(self) -> list[tuple[str, str]]:
        """The parts that are left out, with the reasons."""
        return self._handle.savings()

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, (self.sample_rate, self.profile, self._setup, self.params)


def _made(
    rate: float, profile: Optional[Profile], setup: tuple[int, float, float], params: dict[str, Any]
) -> Translator:
    bands, max_boost, strength = setup
    return Translator(rate, profile=profile, bands=bands, max_boost=max_boost, strength=strength, **params)
