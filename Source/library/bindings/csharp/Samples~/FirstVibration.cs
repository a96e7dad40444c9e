// The first vibration: loads a clip, plays it and writes what drives the actuator as raw 32-bit floats.
using System;
using Pacini;

static class FirstVibration
{
    static void Main(string[] arguments)
    {
        using (var engine = new Engine("lra-175"))
        using (var clip = Clip.Load(arguments[0]))
        using (var output = Console.OpenStandardOutput())
        {
            engine.Play(clip);
            var drive = new float[256];
            var bytes = new byte[4 * drive.Length];
            for (int block = 0; block < 188; ++block) // a second at 48 kHz
            {
                engine.Render(drive, 1);
                Buffer.BlockCopy(drive, 0, bytes, 0, bytes.Length);
                output.Write(bytes, 0, bytes.Length);
            }
        }
    }
}
