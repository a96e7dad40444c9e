# %% [markdown]
# # Measure an actuator and make it flat
#
# A sweep is played, an accelerometer records it, the response follows, and an equaliser makes it flat. Here a simulated
# wearer takes the place of the actuator; `Recording.load` reads real recordings.

# %%
import matplotlib.pyplot as plt
import numpy as np
import pacini
from pacini import measure

sweep = measure.sweep(duration=5, levels=[-24, -18])
full_scale = 5 * measure.GRAVITY
recordings = [measure.simulate(sweep, profile="l5-wristband", wearer=wearer) for wearer in range(1, 6)]
measured = measure.analyse(recordings, sweep, full_scale=full_scale, name="mine")
print(f"resonance {measured.resonance:.1f} Hz, Q {measured.q:.2f}")
print(f"felt from {measured.felt[0]:.0f} to {measured.felt[1]:.0f} Hz, distortion {measured.distortion:.2g} %")
print(
    f"left out: {measured.outliers}; latency {1e3 * measured.latencies[0]:.2f} ms, clock {measured.drifts[0]:.1f} ppm"
)

# %% [markdown]
# ## The equaliser

# %%
fit = measure.fit(measured)
print(f"{len(fit.sections)} sections leave {fit.rms:.2f} dB RMS, {fit.max:.2f} dB at most")
for section in fit.sections:
    print(f"  {section.type:<9} {section.frequency:7.1f} Hz {section.gain:+6.2f} dB, Q {section.q:.2f}")

# %%
figure, ax = plt.subplots(figsize=(8, 4.5), layout="constrained")
for levels in measured.levels:
    ax.semilogx(levels[-1].frequency, levels[-1].level, color="0.8")
after = measured.level + fit.profile.equalizer_response(measured.frequency)
ax.semilogx(measured.frequency, measured.level, label="measured")
ax.semilogx(measured.frequency, after, label="with the equaliser")
ax.set_xlabel("frequency in Hz")
ax.set_ylabel("level in dB re 1 m/s² at full drive")
ax.legend()
plt.show()

# %% [markdown]
# ## The proof
#
# The sweep through the equaliser, recorded again:

# %%
proof = measure.sweep(duration=5, levels=[-24, -18], profile=fit.profile)
again = [measure.simulate(proof, profile="l5-wristband", wearer=wearer) for wearer in range(1, 6)]
flat = measure.analyse(again, proof, full_scale=full_scale)
verdict = measure.verify(flat, fit.profile)
print("flat" if verdict.passed else "not flat")
print(
    f"mean deviation {verdict.mean_deviation:.2f} dB, worst {verdict.worst_deviation:+.2f} dB "
    f"at {verdict.worst_frequency:.0f} Hz"
)

# %% [markdown]
# The profile with all of it plays clips:

# %%
clip = pacini.Clip(0.5, [pacini.Band(60, 100, 160, amplitude=[(0, 1), (0.5, 0)])])
drive = pacini.render(clip, profile=verdict.profile)
print(f"{len(drive)} frames, up to {np.abs(drive).max():.2f}")
