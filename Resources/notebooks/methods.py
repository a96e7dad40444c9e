# %% [markdown]
# # Error against run time of all methods
#
# Pacini's own translation, `a2vt`, beside the others that it comes with, on the sounds of the demo.

# %%
import os
import time
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pacini

demo = Path(os.environ.get("PACINI_DEMO", "../demo"))
sounds = [pacini.read_audio(path) for path in sorted(demo.glob("*.flac"))]
for method in pacini.methods():
    print(f"{method.name:<18} {method.description}")


# %%
def translated(method, samples, rate):
    """The drive signal of a method, and the time that it took."""
    start = time.perf_counter()
    if method.output == "clip":
        made = pacini.encode(samples, rate, method=method.name)
        seconds = time.perf_counter() - start
        return pacini.render(made, rate), seconds
    signal, _ = pacini.translate(samples, rate, method=method.name)
    return signal, time.perf_counter() - start


results = {}
for method in pacini.methods():
    matches, seconds = [], 0.0
    for samples, rate in sounds:
        drive, took = translated(method, samples, rate)
        seconds += took
        matches.append(pacini.compare(samples, drive, rate).match)
    results[method.name] = (seconds, float(np.mean(matches)))

# %% [markdown]
# Predicted match, the mean over the sounds:

# %%
for name, (_, match) in sorted(results.items(), key=lambda result: -result[1][1]):
    print(f"{name:<18} {match:5.1f}")

# %% [markdown]
# The nearer to the upper left, the better. Times are of one run on one processor.

# %%
length = sum(samples.shape[-1] / rate for samples, rate in sounds)
figure, ax = plt.subplots(figsize=(8, 5), layout="constrained")
for name, (seconds, match) in results.items():
    ax.plot(1e3 * seconds / length, match, "o")
    ax.annotate(name, (1e3 * seconds / length, match), textcoords="offset points", xytext=(5, 4), fontsize=8)
ax.set_xscale("log")
ax.set_xlabel("ms of work for a second of sound")
ax.set_ylabel("predicted match")
plt.show()
