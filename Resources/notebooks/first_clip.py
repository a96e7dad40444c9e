# %% [markdown]
# # The first clip
#
# A recording becomes a clip, the clip a drive signal for an actuator, and a measure says how close that is to the sound.

# %%
import os
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pacini

demo = Path(os.environ.get("PACINI_DEMO", "../demo"))
sound = demo / "knock_wood_bridge.flac"
clip = pacini.encode(sound)
clip

# %% [markdown]
# Its curves are structured arrays. All of it takes little room:

# %%
samples, rate = pacini.read_audio(sound)
packed = clip.to_bytes()
print(f"{samples.size} samples, {clip.breakpoints} breakpoints, {len(clip.transients)} events, {len(packed)} bytes")
print(clip.transients[:3])

# %%
figure, (above, below) = plt.subplots(2, 1, figsize=(8, 6), sharex=True, layout="constrained")
mono = samples if samples.ndim == 1 else samples.mean(axis=0)
above.plot(np.arange(len(mono)) / rate, mono, linewidth=0.5)
above.set_ylabel("sound")
clip.plot(ax=below)
plt.show()

# %% [markdown]
# ## What an actuator plays of it, and what is felt

# %%
for name in ("l5-wristband", "lra-175"):
    drive = pacini.render(clip, rate, profile=name)
    skin = pacini.felt(clip, rate, profile=name, full_scale=1)
    print(f"{name}: drive up to {np.abs(drive).max():.2f}, felt up to {np.abs(skin).max():.1f} m/s²")
    for where, what in pacini.explain(clip, profile=name).adaptations:
        print(f"  {where} {what}")

# %% [markdown]
# ## How close it is
#
# The predicted match is how well people would say that the vibration matches the sound, beside that of the sound itself,
# played as it is.

# %%
comparison = pacini.compare(sound, clip)
print(f"match {comparison.match:.1f}, of the sound itself {comparison.match_of_sound:.1f}; HTS {comparison.hts:.1f}")

# %% [markdown]
# ## Edits
#
# Each returns a new clip. Here the first half, an octave lower, with half as many points:

# %%
edited = clip[: clip.duration / 2].transposed(-12)
edited = edited.simplified(count=8)
print(edited)
for loss in edited.lint("ahap")[:3]:
    print(f"AHAP: {loss.message}")
edited
