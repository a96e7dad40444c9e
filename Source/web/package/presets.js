// Made by Resources/docs/make_parameters.py.

export const presets = [
  {"name": "effects", "purpose": "Good for most sounds", "values": {"bands": 12, "breakpoints": 20, "quantise": 6, "low": 30, "high": 1000, "sensitivity": 1, "audible": 1, "heard": "beside", "speech": 1}},
  {"name": "fine-detail", "purpose": "More bands and points", "values": {"bands": 24, "breakpoints": 60, "quantise": 8, "low": 30, "high": 1000, "sensitivity": 1, "audible": 1, "heard": "beside", "speech": 1}},
  {"name": "small-file", "purpose": "Few bands and points", "values": {"bands": 6, "breakpoints": 8, "quantise": 5, "low": 30, "high": 1000, "sensitivity": 1, "audible": 1, "heard": "beside", "speech": 1}},
  {"name": "transients-first", "purpose": "Finds weak and close hits", "values": {"bands": 8, "breakpoints": 20, "quantise": 6, "low": 30, "high": 1000, "sensitivity": 2, "audible": 1, "heard": "beside", "speech": 1}},
  {"name": "steady-texture", "purpose": "Only clear hits become events", "values": {"bands": 12, "breakpoints": 30, "quantise": 6, "low": 30, "high": 1000, "sensitivity": 0.5, "audible": 1, "heard": "beside", "speech": 1}},
  {"name": "low-rumble", "purpose": "20 to 300 Hz, for large actuators", "values": {"bands": 8, "breakpoints": 20, "quantise": 6, "low": 20, "high": 300, "sensitivity": 1, "audible": 0, "heard": "beside", "speech": 1}},
  {"name": "as-recorded", "purpose": "Ignores sound above the range of touch", "values": {"bands": 12, "breakpoints": 20, "quantise": 6, "low": 30, "high": 1000, "sensitivity": 1, "audible": 0, "heard": "beside", "speech": 1}},
  {"name": "music", "purpose": "The beat first, less of hats and voices", "values": {"bands": 12, "breakpoints": 20, "quantise": 6, "low": 30, "high": 1000, "sensitivity": 1, "audible": 0.5, "heard": "beside", "speech": 1}},
  {"name": "everything-heard", "purpose": "Loudness leads where most of a sound lies above touch", "values": {"bands": 12, "breakpoints": 20, "quantise": 6, "low": 30, "high": 1000, "sensitivity": 1, "audible": 1, "heard": "instead", "speech": 1}},
  {"name": "voice-off", "purpose": "As effects, with less of speech", "values": {"bands": 12, "breakpoints": 20, "quantise": 6, "low": 30, "high": 1000, "sensitivity": 1, "audible": 1, "heard": "beside", "speech": 0}}
]
