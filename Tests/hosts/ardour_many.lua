-- A session of many tracks, each with the plugin, in turns as each kind of KINDS ("LV2=ID VST3=ID"). MAKE=COUNT makes
-- it, with Intensity at -1 to -COUNT/2 dB in turns or, in kinds whose values are places on the control's way, a
-- hundredth more on each track. Without, it is opened, played with noise at all inputs, and saved again. Environment:
-- SESSION_DIR.
io.stdout:setvbuf("no")
local backend = AudioEngine:set_backend("None (Dummy)", "", "")
backend:set_device_name("Pink Noise (low CPU)")
backend:set_sample_rate(48000)
backend:set_buffer_size(1024)
local count = tonumber(os.getenv("MAKE"))

local function intensity(processor)
  for parameter in processor:to_automatable():all_automatable_params():iter() do
    local one = processor:to_automatable():automation_control(parameter, true)
    if not one:isnil() and one:desc().label == "Intensity" then
      return one
    end
  end
end

if count then
  Session = create_session(os.getenv("SESSION_DIR"), "pacini", 48000)
  assert(Session)
  print("stage: with the plugin")
  local kinds = {}
  for kind, name in os.getenv("KINDS"):gmatch("(%w+)=(%S+)") do
    kinds[#kinds + 1] = { kind, name }
  end
  local made = Session:new_audio_track(2, 2, nil, count, "Track", ARDOUR.PresentationInfo.max_order,
    ARDOUR.TrackMode.Normal, true)
  local at = 0
  for track in made:iter() do
    at = at + 1
    local kind = kinds[at % #kinds + 1]
    local plugin = ARDOUR.LuaAPI.new_plugin(Session, kind[2], ARDOUR.PluginType[kind[1]], "")
    assert(not plugin:isnil(), "the host does not know the plugin")
    assert(track:add_processor_by_index(plugin, 0, nil, true) == 0, "the host does not insert the plugin")
    local value = -math.ceil(at / 2)
    if intensity(plugin):desc().upper == 1 then
      value = 0.3 + at / 100
    end
    intensity(plugin):set_value(value, PBD.GroupControlDisposition.NoGroup)
  end
  sleep(1)
  Session:save_state("")
else
  print("stage: with the plugin")
  Session = load_session(os.getenv("SESSION_DIR"), "pacini")
  assert(Session)
  for track in Session:get_tracks():iter() do
    track:to_track():monitoring_control():set_value(1, PBD.GroupControlDisposition.NoGroup) -- the inputs
  end
  sleep(1)
  Session:request_roll(ARDOUR.TransportRequestSource.TRS_UI)
  sleep(3)
  print("load", AudioEngine:get_dsp_load())
  print("played", Session:transport_sample())
  for track in Session:get_tracks():iter() do
    local processor = track:nth_plugin(0)
    assert(not processor:isnil(), "the session has lost a plugin")
    print("track", intensity(processor):get_value(),
      track:peak_meter():meter_level(2, ARDOUR.MeterType.MeterMaxPeak))
  end
  Session:request_stop(false, false, ARDOUR.TransportRequestSource.TRS_UI)
  sleep(1)
  Session:save_state("")
  sleep(1)
end
close_session()
print("stage: done")
quit()
