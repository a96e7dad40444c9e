# The first vibration: plays knock.json on the left channel of the sound output.
extends AudioStreamPlayer

var pacini = preload("res://addons/pacini/pacini.gd").new()
var engine = pacini.engine({"actuators": [{"profile": "lra-175"}]})

func _ready():
	stream = AudioStreamGenerator.new()
	stream.mix_rate = 48000
	play()
	engine.play(pacini.clip("res://knock.json"))

func _process(_delta):
	engine.fill(get_stream_playback())
