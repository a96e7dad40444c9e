-- Makes a session of two tracks, Music (2 channels) and SC (1 channel), each with a region of silence of some seconds,
-- recorded, since this is what makes files whose content can then be replaced. Environment: SESSION_DIR.
io.stdout:setvbuf("no")
local backend = AudioEngine:set_backend("None (Dummy)", "", "")
backend:set_device_name("Silence")
backend:set_sample_rate(48000)
backend:set_buffer_size(1024)
Session = create_session(os.getenv("SESSION_DIR"), "pacini", 48000)
assert(Session)

local function newTrack(name, channels)
  local made = Session:new_audio_track(channels, channels, nil, 1, name, ARDOUR.PresentationInfo.max_order,
    ARDOUR.TrackMode.Normal, true)
  for track in made:iter() do
    return track
  end
end

local function arm(track, on)
  track:to_track():rec_enable_control():set_value(on, PBD.GroupControlDisposition.NoGroup)
end

local tracks = { newTrack("Music", 2), newTrack("SC", 1) }
for _, track in ipairs(tracks) do
  arm(track, 1)
end
Session:maybe_enable_record(true)
Session:request_roll(ARDOUR.TransportRequestSource.TRS_UI)
sleep(6)
Session:request_stop(false, false, ARDOUR.TransportRequestSource.TRS_UI)
sleep(2)
Session:disable_record(false, false)
for _, track in ipairs(tracks) do
  arm(track, 0)
end
sleep(1)
for _, track in ipairs(tracks) do
  track:to_track():monitoring_control():set_value(2, PBD.GroupControlDisposition.NoGroup) -- what is on disk
end
sleep(1)
Session:save_state("")
sleep(1)
close_session()
print("stage: done")
quit()
