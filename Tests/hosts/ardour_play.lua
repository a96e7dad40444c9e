-- Inserts the plugin on the track Music, feeds its sidechain from SC, records its haptic output on a track of its own and
-- its first main output on another; then tells the controls' values, loads the preset Music, and tells them again.
-- Environment: SESSION_DIR; PLUGIN_ID and PLUGIN_KIND (LV2 or VST3); SOURCE, the place of the parameter Source on its way,
-- empty to leave it.
io.stdout:setvbuf("no")
local backend = AudioEngine:set_backend("None (Dummy)", "", "")
backend:set_device_name("Silence")
backend:set_sample_rate(48000)
backend:set_buffer_size(1024)
Session = load_session(os.getenv("SESSION_DIR"), "pacini")
assert(Session)
local AUDIO = ARDOUR.DataType("audio")
local music = Session:route_by_name("Music")

local function recorder(name)
  local made = Session:new_audio_track(1, 1, nil, 1, name, ARDOUR.PresentationInfo.max_order, ARDOUR.TrackMode.Normal,
    true)
  for track in made:iter() do
    return track
  end
end

local haptic, passed = recorder("HapticRec"), recorder("MainRec")
local kind = ARDOUR.PluginType.LV2
if os.getenv("PLUGIN_KIND") == "VST3" then
  kind = ARDOUR.PluginType.VST3
end
print("stage: with the plugin")
local plugin = ARDOUR.LuaAPI.new_plugin(Session, os.getenv("PLUGIN_ID"), kind, "")
assert(not plugin:isnil(), "the host does not know the plugin")
assert(music:add_processor_by_index(plugin, 0, nil, true) == 0, "the host does not insert the plugin")
assert(music:add_sidechain(plugin), "the host makes no sidechain")
local insert = plugin:to_plugininsert()
local pins = ARDOUR.ChanMapping()
for i = 0, 2 do
  pins:set(AUDIO, i, i) -- the sidechain comes behind the main inputs
end
insert:set_input_map(0, pins)
for i = 0, 2 do
  print("pin", i, "in", insert:input_map(0):get(AUDIO, i), "out", insert:output_map(0):get(AUDIO, i))
end
if os.getenv("SOURCE") ~= "" then
  print("parameter set", ARDOUR.LuaAPI.set_processor_param(plugin, 0, tonumber(os.getenv("SOURCE"))))
end
if not music:panner_shell():isnil() then
  music:panner_shell():set_bypassed(true) -- it would mix the haptic channel into the sound
end
AudioEngine:disconnect("SC/audio_out 1", "Master/audio_in 1")
AudioEngine:connect("SC/audio_out 1", insert:sidechain_input():nth(0):name())
print("outputs of the track", music:output():n_ports():n_audio())
for track, output in pairs({ [haptic] = 3, [passed] = 1 }) do
  local name = track:name()
  AudioEngine:disconnect(name .. "/audio_out 1", "Master/audio_in 1")
  for port = 1, 4 do
    AudioEngine:disconnect("system:capture_" .. port, name .. "/audio_in 1")
  end
  AudioEngine:connect("Music/audio_out " .. output, name .. "/audio_in 1")
  track:to_track():rec_enable_control():set_value(1, PBD.GroupControlDisposition.NoGroup)
end
Session:goto_start(false)
sleep(1)
Session:maybe_enable_record(true)
Session:request_roll(ARDOUR.TransportRequestSource.TRS_UI)
sleep(4)
print("played to", Session:transport_sample())
Session:request_stop(false, false, ARDOUR.TransportRequestSource.TRS_UI)
sleep(2)
Session:disable_record(false, false)

local function tell(when)
  for parameter in plugin:to_automatable():all_automatable_params():iter() do
    local control = plugin:to_automatable():automation_control(parameter, true)
    if not control:isnil() then
      print(when .. "\t" .. control:desc().label .. "\t" .. control:get_value() .. "\t" .. control:desc().normal)
    end
  end
end
tell("loaded")
assert(insert:plugin(0):load_preset(insert:plugin(0):preset_by_label("Music")), "the host does not load the preset")
sleep(1)
tell("preset")
Session:save_state("")
sleep(1)
close_session()
print("stage: done")
quit()
