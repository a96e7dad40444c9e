"""Types of options; made by Resources/docs/make_parameters.py."""

from typing import Optional, TypedDict

from ._profile import AnyProfile


class EncodeOptions(TypedDict, total=False):
    """Options of encoding; None is the method's own."""

    bands: Optional[int]
    breakpoints: Optional[float]
    quantise: Optional[int]
    low: Optional[float]
    high: Optional[float]
    spacing: Optional[str]
    sensitivity: Optional[float]
    audible: Optional[float]
    heard: Optional[str]
    speech: Optional[float]
    keep_level: Optional[bool]
    minimum_gap: Optional[float]
    mask_margin: Optional[float]
    mask_slope: Optional[float]
    mask_recovery: Optional[float]
    mask_limit: Optional[float]
    silence: Optional[float]
    attack: Optional[float]
    hold: Optional[float]
    release: Optional[float]
    crest_adaptive: Optional[bool]
    crest_memory: Optional[float]
    low_limit: Optional[float]
    high_limit: Optional[float]
    transient_threshold: Optional[float]
    transient_amplitude: Optional[float]


class ExportOptions(TypedDict, total=False):
    """Options of formats of other programs; None is the usual."""

    points: Optional[float]
    frequency_points: Optional[float]
    split: Optional[bool]
    quick: Optional[bool]
    events: Optional[str]
    max_points: Optional[int]
    min_segment: Optional[int]
    max_segment: Optional[int]
    sample_rate: Optional[int]
    strength: Optional[float]
    profile: Optional[AnyProfile]
