"""Clips in notebooks: lanes as SVG, a sound player, and plots with matplotlib."""

from __future__ import annotations

import base64
import io
import math
import struct
from html import escape
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._clip import Band, Clip

WIDTH, LEFT, RIGHT = 720.0, 64.0, 8.0
ENVELOPE, LANE, AXIS = 56.0, 26.0, 22.0
LOUDEST_SECONDS = 60.0  # longer clips have no player: it is part of the notebook


def _at(points: npt.NDArray[np.void], times: npt.NDArray[np.float64], field: str, empty: float) -> npt.NDArray[Any]:
    if len(points) == 0:
        return np.full(len(times), empty)
    values: npt.NDArray[Any] = np.interp(times, points["time"], points[field])
    return values


def _colour(band: Band, low: float, high: float) -> str:
    span = math.log(max(high / max(low, 1e-3), 1.0001))
    share = min(1.0, max(0.0, math.log(max(band.centre, 1e-3) / max(low, 1e-3)) / span))
    return f"hsl({220 - 200 * share:.0f} 65% 50%)"


def _area(points: npt.NDArray[np.void], duration: float, top: float, height: float, peak: float, colour: str) -> str:
    if len(points) == 0 or duration <= 0.0 or peak <= 0.0:
        return ""
    scale = (WIDTH - LEFT - RIGHT) / duration
    x = LEFT + scale * np.concatenate([[0.0], points["time"], [duration]])
    values = np.concatenate([points["amplitude"][:1], points["amplitude"], points["amplitude"][-1:]])
    y = top + height * (1.0 - np.minimum(values / peak, 1.0))
    outline = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
    base = top + height
    return (
        f'<polygon points="{x[0]:.1f},{base:.1f} {outline} {x[-1]:.1f},{base:.1f}" fill="{colour}" '
        f'fill-opacity="0.45" stroke="{colour}" stroke-width="1"/>'
    )


def _nice_step(duration: float) -> float:
    rough = max(duration, 1e-3) / 8.0
    power = 10.0 ** math.floor(math.log10(rough))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= rough)


def clip_svg(clip: Clip) -> str:
    """The envelope with the transients, and a lane for each band, the highest on top."""
    bands = sorted(clip.bands, key=lambda band: band.centre, reverse=True)
    peak = max([1e-9, *(float(band.amplitude["amplitude"].max()) for band in bands if len(band.amplitude))])
    top = 8.0 + ENVELOPE
    height = top + LANE * len(bands) + AXIS
    scale = (WIDTH - LEFT - RIGHT) / clip.duration if clip.duration > 0.0 else 0.0
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:.0f} {height:.0f}" width="{WIDTH:.0f}" '
        f'height="{height:.0f}" font-family="sans-serif" font-size="10" fill="currentColor" role="img">',
        f"<title>{escape(clip.name or 'clip')}: {clip.duration:.3f} s</title>",
    ]

    def label(text: str, y: float) -> None:
        parts.append(f'<text x="{LEFT - 6:.0f}" y="{y:.1f}" text-anchor="end">{escape(text)}</text>')

    envelope = clip.envelope
    most = float(envelope["amplitude"].max()) if len(envelope) else 1.0
    label("envelope", 8.0 + 0.5 * ENVELOPE + 3.0)
    parts.append(_area(envelope, clip.duration, 8.0, ENVELOPE - 4.0, max(most, 1.0), "hsl(0 0% 50%)"))
    for event in clip.transients:
        x = LEFT + scale * float(event["time"])
        y = 8.0 + (ENVELOPE - 4.0) * (1.0 - min(1.0, float(event["amplitude"]) / max(most, 1.0)))
        hue = 20.0 + 30.0 * (1.0 - float(event["sharpness"]))
        parts.append(
            f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{4.0 + ENVELOPE:.1f}" y2="{y:.1f}" stroke="hsl({hue:.0f} 90% 50%)" '
            f'stroke-width="1.5"/><circle cx="{x:.1f}" cy="{y:.1f}" r="2" fill="hsl({hue:.0f} 90% 50%)"/>'
        )
    for i, band in enumerate(bands):
        y = top + LANE * i
        label(f"{band.centre:.0f} Hz", y + 0.5 * LANE + 3.0)
        colour = _colour(band, bands[-1].centre, bands[0].centre)
        parts.append(_area(band.amplitude, clip.duration, y, LANE - 3.0, peak, colour))
    bottom = height - AXIS
    parts.append(
        f'<line x1="{LEFT:.0f}" x2="{WIDTH - RIGHT:.0f}" y1="{bottom:.1f}" y2="{bottom:.1f}" stroke="currentColor"/>'
    )
    step = _nice_step(clip.duration)
    for k in range(int(clip.duration / step + 1e-9) + 1):
        x = LEFT + scale * k * step
        parts.append(
            f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{bottom:.1f}" y2="{bottom + 4:.1f}" stroke="currentColor"/>'
            f'<text x="{x:.1f}" y="{bottom + 15:.1f}" text-anchor="middle">{k * step:.4g} s</text>'
        )
    parts.append("</svg>")
    return "".join(parts)


def _wav(samples: npt.NDArray[np.floating[Any]], rate: int) -> bytes:
    pcm = (np.clip(samples, -1.0, 1.0) * 32767.0).round().astype("<i2").tobytes()
    file = io.BytesIO()
    file.write(b"RIFF" + struct.pack("<I", 36 + len(pcm)) + b"WAVEfmt ")
    file.write(struct.pack("<IHHIIHH", 16, 1, 1, rate, 2 * rate, 2, 16))
    file.write(b"data" + struct.pack("<I", len(pcm)) + pcm)
    return file.getvalue()


def clip_html(clip: Clip) -> str:
    """The lanes, and a player of the drive signal."""
    player = ""
    if 0.0 < clip.duration <= LOUDEST_SECONDS:
        from ._sound import render

        rate = 8000
        data = base64.b64encode(_wav(render(clip, rate), rate)).decode()
        player = f'<br><audio controls src="data:audio/wav;base64,{data}"></audio>'
    about = (
        f"<b>{escape(clip.name or 'clip')}</b> &middot; {clip.duration:.3f} s &middot; {len(clip.bands)} bands "
        f"&middot; {clip.breakpoints} breakpoints &middot; {len(clip.transients)} transients"
    )
    return f"<div>{about}<br>{clip_svg(clip)}{player}</div>"


def plot_clip(clip: Clip, ax: Optional[Axes], **style: Any) -> Axes:
    """Bands over time by their pitch, as wide as they are strong, with transients as stems."""
    if ax is None:
        import matplotlib.pyplot as plt

        ax = plt.subplots(layout="constrained")[1]
    peak = max([1e-9, *(float(band.amplitude["amplitude"].max()) for band in clip.bands if len(band.amplitude))])
    centres = [band.centre for band in clip.bands]
    for band in clip.bands:
        times = np.unique(np.concatenate([[0.0, clip.duration], band.amplitude["time"], band.pitch["time"]]))
        amplitude = _at(band.amplitude, times, "amplitude", 0.0)
        pitch = _at(band.pitch, times, "frequency", band.centre)
        reach = (band.high / band.low) ** 0.5 if band.low > 0.0 else 1.2
        width = reach ** (amplitude / peak)
        given = {"color": plot_colour(band.centre, centres), "alpha": 0.6, "linewidth": 0.0, **style}
        ax.fill_between(times, pitch / width, pitch * width, **given)
    if len(clip.transients):
        low = min(centres, default=30.0) / 1.5
        heights = low * 1.4 ** clip.transients["amplitude"]
        ax.vlines(clip.transients["time"], low, heights, color="tab:red", linewidth=1.5, label="transients")
    ax.set_yscale("log")
    ax.set_xlim(0.0, clip.duration if clip.duration > 0.0 else 1.0)
    ax.set_xlabel("time in s")
    ax.set_ylabel("frequency in Hz")
    if clip.name:
        ax.set_title(clip.name)
    return ax


def plot_colour(centre: float, centres: list[float]) -> Any:
    """From blue for the lowest band to red for the highest."""
    from matplotlib import colormaps

    low, high = math.log(max(min(centres), 1e-3)), math.log(max(max(centres), 1e-3))
    share = (math.log(max(centre, 1e-3)) - low) / (high - low) if high > low else 0.0
    return colormaps["turbo"](0.1 + 0.8 * share)
