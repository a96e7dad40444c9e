"""End to end: every row of the table of sounds in formats.md, by a file of its kind."""
import json
import os
import shutil
import struct
import subprocess
import unittest

from command import SOURCE, CommandTest, sine, wav

RATE = 48000
SOUNDS = SOURCE / "Tests/io/audio"
HAS_FFMPEG = shutil.which("ffmpeg") and shutil.which("ffprobe")


def rows():
    """The kinds of files of the table, with what is said to happen to them."""
    text = (SOURCE / "Resources/docs/formats.md").read_text().split("\n## Sounds\n")[1].split("\n## ")[0]
    lines = [line.strip("| ") for line in text.splitlines() if line.startswith("| ")]
    return dict(line.split(" | ") for line in lines if " | " in line)


def chunk(name, content):
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def with_size(sound, size):
    at = sound.index(b"data") + 4
    return sound[:at] + struct.pack("<I", size) + sound[at + 4:]


def cue(frame, played=None):
    return chunk(b"cue ", struct.pack("<III4sIII", 1, 1, frame if played is None else played, b"data", 0, 0, frame))


def loops(first, last):
    return chunk(b"smpl", bytes(28) + struct.pack("<II", 1, 0) + struct.pack("<6I", 0, 0, first, last, 0, 0))


def id3(frames=b""):
    size = len(frames)
    return b"ID3\4\0\0" + bytes(size >> shift & 0x7F for shift in (21, 14, 7, 0)) + frames


def ogg_page(page, granule):
    """A page of an Ogg stream with another granule position, its checksum made anew (RFC 3533)."""
    page, crc = bytearray(page), 0
    page[6:14], page[22:26] = struct.pack("<q", granule), bytes(4)
    for byte in page:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ (0x04C11DB7 if crc >> 31 else 0)) & 0xFFFFFFFF
    page[22:26] = struct.pack("<I", crc)
    return bytes(page)


def chapter(ms):
    content = b"a\0" + struct.pack(">IIII", ms, ms + 1, 0xFFFFFFFF, 0xFFFFFFFF)
    return b"CHAP" + struct.pack(">IH", len(content), 0) + content


def stated_sounds(samples):
    """Files of less common formats that state how long their sound is, of samples of 16 bits, one second of them."""
    values = struct.unpack(f"<{len(samples) // 2}h", samples)
    count, big = len(values), struct.pack(f">{len(values)}h", *values)
    nist = (f"NIST_1A\n   1024\nchannel_count -i 1\nsample_rate -i {RATE}\nsample_n_bytes -i 2\nsample_sig_bits -i 16\n"
            f"sample_coding -s3 pcm\nsample_byte_format -s2 01\nsample_count -i {count}\nend_head\n")
    yield "NIST", nist.encode().ljust(1024) + samples
    block = struct.pack("<I", 12 + len(samples))[:3] + struct.pack("<IBBH4x", RATE, 16, 1, 4)
    yield "VOC", b"Creative Voice File\x1a" + struct.pack("<HHH", 26, 0x114, 0x111F) + b"\x09" + block + samples + b"\0"
    avr = struct.pack(">4s8sHHHHHIIII", b"2BIT", b"", 0, 16, 0xFFFF, 0, 0xFFFF, RATE, count, 0, 0)
    yield "AVR", avr.ljust(128, b"\0") + big
    head = struct.pack(">4sIIIIHBBI", b"VHDR", 20, count, 0, 0, RATE, 1, 0, 0xFFFF)
    body = b"16SV" + head + b"BODY" + struct.pack(">I", len(big)) + big
    yield "8SVX", b"FORM" + struct.pack(">I", len(body)) + body
    rate = struct.pack("<5I", 0, 1, 1, 0, 11) + b"samplerate\0" + struct.pack("<d", RATE)
    yield "MAT 4", rate + struct.pack("<5I", 30, 1, count, 0, 9) + b"wavedata\0" + samples
    mpc = b"\1\4" + b"x".ljust(17) + struct.pack("<BBBIIIIBBH", 100, 0, 0, 0, count, count, count, 0, 1, RATE)
    yield "MPC 2000", mpc + samples
    def sevens(number):
        return bytes(number >> shift & 127 for shift in (0, 7, 14))
    sds = b"\xf0\x7e\0\1\0\0\x10" + sevens(10**9 // RATE) + sevens(count) + bytes(6) + b"\0\xf7"
    for packet in range(0, count, 40):
        words = [value + 32768 for value in values[packet:packet + 40]]
        data = b"".join(bytes([word >> 9, word >> 2 & 127, word << 5 & 127]) for word in words).ljust(120, b"\0")
        sds += b"\xf0\x7e\0\2" + bytes([packet // 40 & 127]) + data + b"\0\xf7"
    yield "SDS", sds


class SoundTable(CommandTest):
    def setUp(self):
        super().setUp()
        self.sound = wav(sine(100, 1.0))
        self.bytes = len(self.sound) - 44
        self.mp3 = (SOUNDS / "tone.mp3").read_bytes()
        self.left = rows()

    def row(self, begins):
        """What the table says of the one row that begins so."""
        found = [kind for kind in self.left if kind.startswith(begins)]
        self.assertEqual(len(found), 1, begins)
        return self.left.pop(found[0])

    def encode(self, content, *options, name="x.wav", env=None):
        self.put(name, content)
        done = self.run_command("encode", name, "-o", "x.json", "-y", *options, **({"env": env} if env else {}))
        self.said = done.stderr.decode()
        self.clip_read = json.loads((self.folder / "x.json").read_text()) if done.returncode == 0 else None
        return done.returncode

    def reads(self, says, content, seconds=1.0, **options):
        self.assertIn("read", says + " read" if "marker" in says or "left out" in says or "passed" in says else says)
        self.assertEqual(self.encode(content, **options), 0, self.said)
        self.assertEqual(self.said, "")
        self.assertAlmostEqual(self.clip_read["duration"], seconds, delta=0.001)

    def reads_with_a_word(self, says, content, word, seconds=1.0, options=()):
        self.assertIn("warning", says)
        self.assertEqual(self.encode(content, *options), 0, self.said)
        self.assertIn("pacini: x.wav: warning: ", self.said)
        self.assertIn(word, self.said)
        self.assertAlmostEqual(self.clip_read["duration"], seconds, delta=0.03)

    def refuses(self, says, content, word):
        self.assertIn("refused", says)
        self.assertEqual(self.encode(content), 1)
        self.assertRegex(self.said, r"^pacini: x\.wav: [^\n]+\n$")
        self.assertIn(word, self.said)

    def markers(self):
        return [marker["time"] for marker in self.clip_read["markers"]]

    def check_words(self):
        """How samples lie in their words."""
        tone = sine(100, 1.0)

        def words(kind, values, bits=24):
            data = struct.pack(f"<{len(values)}{kind}", *values)
            described = struct.pack("<HHIIHH", 3 if bits == 0 else 1, 1, RATE, 4 * RATE, 4, bits or 32)
            return chunk(b"RIFF", b"WAVE" + chunk(b"fmt ", described) + chunk(b"data", data))

        def integers(scale):
            return [round(x * 8388607) * scale for x in tone]

        self.reads(self.row("integers of fewer bits"), words("i", integers(256)))
        self.reads_with_a_word(self.row("such integers at the low end"), words("i", integers(1)), "48 dB")
        says = self.row("words of 32 bits of which")
        self.reads_with_a_word(says, words("i", integers(1), 32), "48 dB below full scale")
        says = self.row("floating-point numbers that a WAV")
        self.reads_with_a_word(says, words("f", [32768 * x for x in tone], 16), "floating-point numbers")
        says = self.row("floating-point samples that are all whole")
        self.reads_with_a_word(says, words("f", [round(32767 * x) for x in tone], 0), "16 bits")
        says = self.row("floating-point samples beyond 256")
        self.reads_with_a_word(says, words("f", [32768 * x for x in tone], 0), "times full scale")

    def check_texts(self):
        """Texts in front of and behind the samples."""
        tone = self.sound[44:]
        samples = b"".join(tone[i + 1:i + 2] + tone[i:i + 1] for i in range(0, len(tone), 2))
        text = b"recorded at home with two microphones\0\0\0"
        says = self.row("an AU whose sound begins within its text")
        self.reads_with_a_word(says, b".snd" + struct.pack(">5I", 32, len(samples), 3, RATE, 1) + text + samples,
                               "read from byte 64 on")
        item = struct.pack("<II", 5, 0) + b"Title\0Hello"
        footer = b"APETAGEX" + struct.pack("<4I", 2000, len(item) + 32, 1, 0x80000000) + bytes(8)
        self.reads(self.row("the footer of an APE tag"), with_size(self.sound, 0xFFFFFFFF) + item + footer)

    def check_stated_lengths(self):
        """Lengths that libsndfile does not hold against the file."""
        kinds = self.row("a NIST, VOC, AVR, 8SVX")
        behind = self.row("more than 64 bytes behind")
        for name, content in stated_sounds(self.sound[44:]):
            self.assertEqual(self.encode(content), 0, name + self.said)
            self.assertEqual(self.said, "", name)
            self.assertAlmostEqual(self.clip_read["duration"], 1.0, delta=0.001, msg=name)
            cut = content[:len(content) * 6 // 10]
            self.refuses(kinds, cut, "is truncated")
            self.assertEqual(self.encode(cut, "--allow-truncated"), 0, name + self.said)
            self.assertRegex(self.said, r"warning: is cut off: 0\.(59|6)\d* s of 1\.000 s are there", name)
            if name != "8SVX":  # libsndfile refuses one that another follows
                self.reads_with_a_word(behind, content + content, "behind its sound that are left out")

    def check_numbered_blocks(self):
        """A FLAC from a program that streams: the number of its last block tells how long it is."""
        says = self.row("a FLAC that states no length")
        if not HAS_FFMPEG:
            return
        self.put("a.wav", wav(sine(100, 3.0)))
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", "a.wav", "b.flac"], cwd=self.folder, check=True)
        flac = (self.folder / "b.flac").read_bytes()
        flac = flac[:21] + bytes([flac[21] & 0xF0]) + bytes(4) + flac[26:]
        blocks = [at for at in range(42, len(flac)) if flac.startswith(b"\xff\xf8", at)]
        self.assertGreater(len(blocks), 30)
        self.reads("read", flac, 3.0)
        hole = flac[:blocks[5]] + flac[blocks[20]:]  # the decoder fills a few blocks up
        self.refuses(says, hole, "frames of 144000")
        self.assertEqual(self.encode(hole, "--allow-truncated"), 0, self.said)
        self.assertIn("of 3.000 s are there", self.said)

    def test_every_row_is_true(self):
        sound, mp3, size = self.sound, self.mp3, self.bytes
        says = self.row("WAV (RIFF")
        for path in sorted(SOUNDS.iterdir()):
            self.assertEqual(self.encode(path.read_bytes()), 0, path.name + self.said)
            self.assertEqual(self.said, "", path.name)
        self.reads(says, sound)
        says = self.row("tags (ID3, APE, Lyrics3)")
        self.reads(says, id3(b"\0" * 300) + sound + b"TAG" + bytes(125))
        says = self.row("a size that was left open")
        for open_size in (0xFFFFFFFF, 0x80000000, 0x7FFFFF00, 2_000_000_000):
            self.reads(says, with_size(sound, open_size))
        says = self.row("a size of 0 or smaller")
        for less in (0, size // 2):
            self.reads_with_a_word(says, with_size(sound, less), "all of them are read")
        says = self.row("a size that is too large")
        for more in (size + 44, size + 64, 2 * size):
            self.reads_with_a_word(says, with_size(sound, more), "all of them are read")
        says = self.row("an MP3 without a header")
        second = mp3.index(mp3[:2], 50)
        self.assertEqual(self.encode(mp3), 0)
        whole = self.clip_read["duration"]
        self.assertEqual(self.encode(mp3[second:]), 0)
        self.assertIn("warning: does not tell how its encoder was primed", self.said)
        self.assertIn("warning", says)
        self.assertGreaterEqual(self.clip_read["duration"], whole)
        says = self.row("MP3 or MP2 inside a WAV")
        form = struct.pack("<HHIIHHH", 0x55, 1, 8000, 1000, 1, 0, 12) + bytes(12)
        inside = b"WAVE" + chunk(b"fmt ", form) + chunk(b"data", mp3)
        self.reads(says, chunk(b"RIFF", inside), whole)
        says = self.row("another codec inside")
        if HAS_FFMPEG:
            self.put("a.wav", sound)
            subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", "a.wav", "-c:a", "adpcm_yamaha", "b.wav"],
                           cwd=self.folder, check=True)
            coded = (self.folder / "b.wav").read_bytes()
            self.assertEqual(self.encode(coded), 0)
            self.assertEqual(self.said, "")
            self.reads_with_a_word(says, with_size(coded, 100), "100 bytes of sound, but")
            self.assertEqual(self.encode(coded, env={**os.environ, "PATH": str(self.folder)}), 1)
            self.assertIn("ffmpeg", self.said)
        says = self.row("cues of a WAV")
        self.reads(says, sound + cue(12000))
        self.assertEqual(self.markers(), [0.25])
        overstated, audio = bytearray(cue(12000)), sound.index(b"data")
        overstated[8] = 9
        self.reads_with_a_word(says, sound[:audio] + bytes(overstated) + sound[audio:], "states 9 markers, of which 1")
        self.assertEqual(self.markers(), [0.25])
        region = chunk(b"LIST", b"adtl" + chunk(b"ltxt", struct.pack("<II4sHHHH", 1, 500, b"rgn ", 0, 0, 0, 0)))
        self.reads_with_a_word(says, sound + cue(12000) + region, "regions")
        says = self.row("chapters: comments")
        for content in (id3(chapter(250)) + sound, sound + chunk(b"id3 ", id3(chapter(250)))):
            self.reads(says, content)
            self.assertEqual(self.markers(), [0.25])
        self.assertEqual(self.encode(mp3 + id3(chapter(10))), 0)
        self.assertEqual(self.markers(), [0.01])
        self.reads(self.row("loops of a WAV"), sound + loops(12000, 23999))
        self.assertEqual(self.markers(), [0.25, 0.5])
        says = self.row("markers behind the end")
        self.reads_with_a_word(says, sound + cue(60000), "behind the end")
        self.reads(self.row("sounds of one rate and number"), sound + sound, 2.0)
        self.reads(self.row("cues that count frames in the order"), sound + cue(0, 12000))
        self.assertEqual(self.markers(), [0.25])
        says = self.row("another sound behind that has another rate")
        self.reads_with_a_word(says, sound + wav(sine(100, 1.0), rate=44100), "another sound")
        says = self.row("audio in several chunks")
        half, data = 44 + size // 2, chunk(b"data", b"")
        self.reads(says, with_size(sound[:half], size // 2) + chunk(b"data", sound[half:]))
        self.reads(says, sound[:36] + data + sound[36:])
        says = self.row("a first frame that an AIFF places")
        samples = sound[44:]
        swapped = b"".join(samples[i + 1:i + 2] + samples[i:i + 1] for i in range(0, len(samples), 2))
        common = struct.pack(">HIHH", 1, size // 2, 16, 16383 + 15) + struct.pack(">Q", RATE << 48)
        for offset, filling in ((0, b""), (512, b"U" * 512), (512, b"")):
            inside = struct.pack(">II", offset, 512) + filling + swapped
            body = b"AIFFCOMM" + struct.pack(">I", 18) + common + b"SSND" + struct.pack(">I", len(inside)) + inside
            self.reads(says, b"FORM" + struct.pack(">I", len(body)) + body)
        says = self.row("sounds that run side by side")
        pages = [b"OggS" + page for page in (SOUNDS / "tone.ogg").read_bytes().split(b"OggS")[1:]]
        others = [b"OggS" + page for page in (SOUNDS / "tone.opus").read_bytes().split(b"OggS")[1:]]
        self.assertEqual(self.encode(b"".join(pages)), 0, self.said)
        alone = self.clip_read["duration"]
        mixed = b"".join([pages[0], others[0], *pages[1:], *others[1:]])
        self.reads_with_a_word(says, mixed, "another sound at the same time", alone)
        self.assertEqual(self.encode(b"".join(pages[:-1])), 0, self.said)
        self.assertIn("lacks the mark of its end", self.said)
        says = self.row("an Ogg of Vorbis whose first frames are before 0")

        def moved(frames):
            times = [struct.unpack("<q", page[6:14])[0] for page in pages]
            return b"".join(ogg_page(page, time - frames if time > 0 else time) for page, time in zip(pages, times))
        self.assertEqual(moved(0), b"".join(pages))
        rate = struct.unpack("<I", pages[0][40:44])[0]
        self.reads(says, moved(100), alone - 100 / rate)
        self.reads_with_a_word(says, moved(3000), "before", alone)
        says = self.row("an Opus whose header leaves out")
        long = bytearray(others[0])
        long[28 + 10:28 + 12] = struct.pack("<H", 24000)
        self.assertEqual(long[28:36], b"OpusHead")
        self.assertEqual(self.encode(b"".join(others)), 0, self.said)
        self.reads_with_a_word(says, b"".join([ogg_page(long, 0), *others[1:]]), "leaves out 0.500 s",
                               self.clip_read["duration"] - 0.5 + struct.unpack("<H", others[0][38:40])[0] / 48000)
        says = self.row("an Opus that leaves out all of its sound")
        long[28 + 10:28 + 12] = b"\xff\xff"
        self.refuses(says, b"".join([ogg_page(long, 0), *others[1:]]), "leaves out 1.365 s")
        says = self.row("an Opus that its header makes more")
        soft = bytearray(others[0])
        soft[28 + 16:28 + 18] = struct.pack("<h", -60 * 256)
        self.reads_with_a_word(says, b"".join([ogg_page(soft, 0), *others[1:]]), "makes it 60 dB softer")
        says = self.row("an Ogg of Vorbis or Opus whose times leave out")
        end = struct.unpack("<q", pages[-1][6:14])[0]
        self.reads_with_a_word(says, b"".join([*pages[:-1], ogg_page(pages[-1], end - rate // 8)]), "leave out 0.1",
                               alone - 0.125)
        says = self.row("pages of an Ogg whose checksums")
        wrong = bytearray(pages[2])
        wrong[13] = 0xf8
        self.reads_with_a_word(says, b"".join([*pages[:2], bytes(wrong), *pages[3:]]), "checksums, about 0.9", 0.037)
        says = self.row("a WAV, W64 or CAF that states other frames")
        self.reads_with_a_word(says, sound[:32] + struct.pack("<H", 4) + sound[34:], "states frames of 4 bytes")
        says = self.row("two descriptions of its samples")
        stereo = chunk(b"fmt ", struct.pack("<HHIIHH", 1, 2, RATE, 4 * RATE, 4, 16))
        self.reads_with_a_word(says, sound[:36] + stereo + sound[36:], "two descriptions")
        self.check_words()
        self.check_stated_lengths()
        self.check_numbered_blocks()
        self.check_texts()
        says = self.row("damaged pictures")
        flac = (SOUNDS / "ramp.flac").read_bytes()
        self.assertEqual(self.encode(flac), 0, self.said)
        picture = bytes([6]) + struct.pack(">I", 30)[1:] + b"\x7f" * 30
        self.reads(says, flac[:4] + bytes([flac[4] & 127]) + flac[5:42] + picture + flac[42:],
                   self.clip_read["duration"])
        says = self.row("a cue sheet in a FLAC")
        sheet = b'CUESHEET=FILE "a" WAVE\nTRACK 01 AUDIO\nINDEX 01 00:00:00\nTRACK 02 AUDIO\nINDEX 01 00:00:03\n'
        comments = struct.pack("<III", 0, 1, len(sheet)) + sheet
        block = bytes([4]) + struct.pack(">I", len(comments))[1:] + comments
        self.reads(says, flac[:4] + bytes([flac[4] & 127]) + flac[5:42] + block + flac[42:], self.clip_read["duration"])
        self.assertEqual([round(time, 3) for time in self.markers()], [0.0, 0.04])
        says = self.row("a list of waves")
        waves = chunk(b"data", sound[44:half]) + chunk(b"slnt", struct.pack("<I", 4800)) + chunk(b"data", sound[half:])
        self.reads(says, chunk(b"RIFF", b"WAVE" + sound[12:36] + chunk(b"LIST", b"wavl" + waves)), 1.1)
        self.reads(says, chunk(b"RIFF", b"WAVE" + sound[36:] + sound[12:36]))
        self.reads_with_a_word(self.row("fewer than 64 bytes behind"), sound + b"abc", "3 bytes")
        says = self.row("24 or 32 bits and floats of an AIFC")
        longer = b"".join(samples[i + 1:i + 2] + samples[i:i + 1] + b"\0" for i in range(0, len(samples), 2))
        common += b"in24\0\0"
        inside = struct.pack(">II", 0, 0) + longer
        body = b"AIFCFVER" + struct.pack(">II", 4, 0xA2805140) + b"COMM" + struct.pack(">I", len(common)) + common
        body += b"SSND" + struct.pack(">I", len(inside)) + inside
        self.reads(says, b"FORM" + struct.pack(">I", len(body)) + body)
        self.reads_with_a_word(self.row("zeros behind the stated end"), sound + bytes(400), "400 bytes")
        says = self.row("a hole in an MP3")
        self.assertIn("warning", says)
        half = len(mp3) // 2
        self.assertEqual(self.encode(mp3[:half] + bytes(700) + mp3[half + 700:], "--allow-truncated"), 0)
        self.assertIn("warning", self.said)
        self.reads_with_a_word(self.row("an MP3 that ends within a block"), mp3[:len(mp3) - 40], "within a block",
                               whole - 0.048, ["--allow-truncated"])  # two blocks
        says = self.row("a rate from 1 to 8 kHz")
        self.reads_with_a_word(says, wav(sine(100, 1.0, rate=3000), rate=3000), "sampled at 3000 Hz")
        says = self.row("a file that is cut off")
        cut = sound[:44 + size * 6 // 10]
        self.refuses(says, cut, "is truncated")
        self.reads_with_a_word(says, cut, "is cut off", 0.6, ["--allow-truncated"])
        says = self.row("a rate below 1 or above 768 kHz")
        for wrong in (wav([0.5] * 100, rate=900), wav([0.5] * 100, rate=800000), wav([0.5] * 650, channels=65),
                      sound[:20] + bytes(4) + sound[24:]):
            self.refuses(says, wrong, "")
        says = self.row("films (MP4")
        film = struct.pack(">I", 16) + b"ftypisom" + bytes(4)
        self.refuses(says, film, "")
        self.assertEqual(list(self.left), [], "rows without a file")


if __name__ == "__main__":
    unittest.main()
