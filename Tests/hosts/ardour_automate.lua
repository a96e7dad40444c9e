-- Inserts the plugin on the track Music and writes automation of its parameter LABEL: straight lines between the points
-- of EVENTS ("FRAME VALUE ..."). Environment: SESSION_DIR, PLUGIN_ID, PLUGIN_KIND (LV2 or VST3), RATE.
io.stdout:setvbuf("no")
local backend = AudioEngine:set_backend("None (Dummy)", "", "")
backend:set_device_name("Silence")
backend:set_sample_rate(tonumber(os.getenv("RATE")))
backend:set_buffer_size(1024)
Session = load_session(os.getenv("SESSION_DIR"), "pacini")
assert(Session)
local music = Session:route_by_name("Music")
local kind = ARDOUR.PluginType.LV2
if os.getenv("PLUGIN_KIND") == "VST3" then
  kind = ARDOUR.PluginType.VST3
end
print("stage: with the plugin")
local processor = ARDOUR.LuaAPI.new_plugin(Session, os.getenv("PLUGIN_ID"), kind, "")
assert(not processor:isnil(), "the host does not know the plugin")
assert(music:add_processor_by_index(processor, 0, nil, true) == 0, "the host does not insert the plugin")
if not music:panner_shell():isnil() then
  music:panner_shell():set_bypassed(true) -- it would mix the haptic channel into the sound
end
local control = nil
for parameter in processor:to_automatable():all_automatable_params():iter() do
  local one = processor:to_automatable():automation_control(parameter, true)
  if not one:isnil() and one:desc().label == os.getenv("LABEL") then
    control = one
  end
end
assert(control, "the host has no such parameter")
local list = control:alist()
list:clear_list()
for frame, value in os.getenv("EVENTS"):gmatch("(%S+) (%S+)") do
  list:add(Temporal.timepos_t(tonumber(frame)), tonumber(value), false, true)
end
control:set_automation_state(ARDOUR.AutoState.Play)
Session:save_state("")
sleep(1)
close_session()
print("stage: done")
quit()
