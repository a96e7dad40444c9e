-- Opens a session with the plugin on the track Music, tells its automation, records the sound that passes and the
-- haptic output in real time, and exports both faster than that. Environment: SESSION_DIR, RATE, FRAMES to export.
io.stdout:setvbuf("no")
local backend = AudioEngine:set_backend("None (Dummy)", "", "")
backend:set_device_name("Silence")
backend:set_sample_rate(tonumber(os.getenv("RATE")))
backend:set_buffer_size(1024)
print("stage: with the plugin")
Session = load_session(os.getenv("SESSION_DIR"), "pacini")
assert(Session)
print("rate", Session:nominal_sample_rate())
local music = Session:route_by_name("Music")
local processor = music:nth_plugin(0)
assert(not processor:isnil(), "the session has lost the plugin")
for parameter in processor:to_automatable():all_automatable_params():iter() do
  local control = processor:to_automatable():automation_control(parameter, false)
  if not control:isnil() and control:alist():size() > 0 then
    for event in control:alist():events():iter() do
      print("event", control:desc().label, event.when:samples(), event.value)
    end
  end
end

local names = { "HapticRec", "MainRec" }
local outputs = { 3, 1 }
for place, name in ipairs(names) do
  local made = Session:new_audio_track(1, 1, nil, 1, name, ARDOUR.PresentationInfo.max_order, ARDOUR.TrackMode.Normal,
    true)
  for track in made:iter() do
    AudioEngine:disconnect(name .. "/audio_out 1", "Master/audio_in 1")
    for port = 1, 4 do
      AudioEngine:disconnect("system:capture_" .. port, name .. "/audio_in 1")
    end
    AudioEngine:connect("Music/audio_out " .. outputs[place], name .. "/audio_in 1")
    track:to_track():rec_enable_control():set_value(1, PBD.GroupControlDisposition.NoGroup)
  end
end
Session:goto_start(false)
sleep(1)
Session:maybe_enable_record(true)
Session:request_roll(ARDOUR.TransportRequestSource.TRS_UI)
sleep(4)
Session:request_stop(false, false, ARDOUR.TransportRequestSource.TRS_UI)
sleep(2)
Session:disable_record(false, false)

-- The master takes both in the place of its mix.
for place, name in ipairs(names) do
  for port = 1, 2 do
    AudioEngine:disconnect("SC/audio_out 1", "Master/audio_in " .. port)
    AudioEngine:disconnect(name .. "/audio_out 1", "Master/audio_in " .. port)
    AudioEngine:disconnect("Music/audio_out " .. port, "Master/audio_in " .. port)
  end
end
AudioEngine:connect("Music/audio_out 3", "Master/audio_in 1")
AudioEngine:connect("Music/audio_out 1", "Master/audio_in 2")
local exporter = Session:simple_export()
exporter:set_folder(os.getenv("SESSION_DIR") .. "/export")
exporter:set_name("both")
assert(exporter:set_preset("7b6a3a08-3f0d-4a55-9b53-1c1f7f3c5a10"), "the host has no such format")
exporter:set_range(0, tonumber(os.getenv("FRAMES")))
print("stage: export")
assert(exporter:run_export(), "the host does not export")
Session:save_state("")
sleep(1)
close_session()
print("stage: done")
quit()
