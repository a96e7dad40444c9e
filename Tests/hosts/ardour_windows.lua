-- Makes a session with the plugin on the master, once as each kind of KINDS ("LV2=ID VST3=ID"). Environment: SESSION_DIR.
io.stdout:setvbuf("no")
local backend = AudioEngine:set_backend("None (Dummy)", "", "")
backend:set_device_name("Silence")
backend:set_sample_rate(48000)
backend:set_buffer_size(1024)
Session = create_session(os.getenv("SESSION_DIR"), "pacini", 48000)
assert(Session)
print("stage: with the plugin")
for kind, name in os.getenv("KINDS"):gmatch("(%w+)=(%S+)") do
  local plugin = ARDOUR.LuaAPI.new_plugin(Session, name, ARDOUR.PluginType[kind], "")
  assert(not plugin:isnil(), "the host does not know the plugin")
  assert(Session:master_out():add_processor_by_index(plugin, 0, nil, true) == 0, "the host does not insert the plugin")
end
Session:save_state("")
sleep(1)
close_session()
print("stage: done")
quit()
