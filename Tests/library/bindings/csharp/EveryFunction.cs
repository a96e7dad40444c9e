// Uses all of the binding; ends with 1 and a reason at the first thing that is not as it should be.
//   EveryFunction.exe layout          sizes and offsets of the structs, as the C compiler's
//   EveryFunction.exe scene PATH      renders 1.5 s of a scene for two actuators to standard output
//   EveryFunction.exe
using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text;
using Pacini;

static class EveryFunction
{
    const string Hum = "{\"format\": \"pacini.clip\", \"version\": 1, \"name\": \"hüm\", \"duration\": 1, \"bands\": " +
        "[{\"lowFrequency\": 90, \"centreFrequency\": 100, \"highFrequency\": 110, \"amplitude\": " +
        "[{\"time\": 0, \"amplitude\": 0.5}, {\"time\": 1, \"amplitude\": 0.5}]}]}";

    static void Check(bool holds, string claim)
    {
        if (!holds)
            throw new Exception(claim);
    }

    static void Throws(Result result, string text, Action work)
    {
        try
        {
            work();
        }
        catch (PaciniException error)
        {
            Check(error.Result == result && error.Message.Contains(text), error.Result + ": " + error.Message + ", not: " + text);
            return;
        }
        Check(false, "does not throw: " + text);
    }

    static float Largest(Engine engine, int frames, int channels = 2, int only = -1)
    {
        var samples = new float[frames * channels];
        Check(engine.Render(samples, channels), "renders");
        return samples.Where((x, i) => only < 0 || i % channels == only).Max(x => Math.Abs(x));
    }

    static void Layout()
    {
        foreach (var type in typeof(Clip).Assembly.GetTypes().Where(t => t.Name.StartsWith("pacini_", StringComparison.Ordinal)))
        {
            Console.WriteLine("{0} {1}", type.Name, Marshal.SizeOf(type));
            foreach (var field in type.GetFields(BindingFlags.Instance | BindingFlags.Public))
                Console.WriteLine("{0}.{1} {2}", type.Name, field.Name, Marshal.OffsetOf(type, field.Name));
        }
    }

    static void Scene(string path)
    {
        using (var engine = new Engine(new EngineConfig(null, null), path))
        using (var output = Console.OpenStandardOutput())
        {
            var samples = new float[2 * 72000];
            engine.Render(samples, 2);
            var bytes = new byte[4 * samples.Length];
            Buffer.BlockCopy(samples, 0, bytes, 0, bytes.Length);
            output.Write(bytes, 0, bytes.Length);
        }
    }

    static void Everything()
    {
        Check(Library.Version >= 1000, "version");
        byte[] hum = Encoding.UTF8.GetBytes(Hum);
        var clip = Clip.FromBytes(hum);
        Clip[] two = Clip.AllFromBytes(hum, hum);
        Check(two.Length == 2 && two[1].Name == "hüm", "several clips");
        Throws(Result.BadData, "bytes[1]: ", () => Clip.AllFromBytes(hum, new byte[] { 1, 2 }));
        Throws(Result.Invalid, "MaxPlays: must be", () => new Engine(new EngineConfig { MaxPlays = 1000000 }));
        Check(clip.Name == "hüm" && clip.Duration == 1.0 && clip.Events == 0 && clip.Bytes > 20, "info of the clip");
        var marked = Clip.FromBytes(Encoding.UTF8.GetBytes(Hum.Replace("\"duration\": 1,",
            "\"duration\": 1, \"markers\": [{\"time\": 0.25, \"name\": \"schön\"}, {\"time\": 0.5, \"name\": \"step\"}, {\"time\": 0.75, \"name\": \"step\"}],")));
        Check(string.Join(" ", marked.Markers.Select(marker => marker.Name)) == "schön step step", "markers");
        Check(Math.Abs(marked.FindMarker("schön").Time - 0.25) < 1e-3 && marked.FindMarker("step", 2).Index == 2, "a marker");
        Throws(Result.Invalid, "no marker 'schön'", () => marked.FindMarker("schön", 1));
        Check(clip.Markers.Length == 0, "no markers");
        var config = new EngineConfig { SampleRate = 8000, MaxPlays = 8 };
        Check(config.Protect && config.PanLaw == PanLaw.Power && config.BudgetFrames == 512, "defaults");
        config.Actuators.Add(new Actuator());
        config.Actuators.Add(new Actuator { Gain = 0.5 });
        var engine = new Engine(config);
        var play = engine.Play(clip, new PlaySettings { Loop = -1, Pan = 0, Frame = 1000 });
        Check(play.State == PlayState.Waiting, "waits");
        Check(Largest(engine, 1000) == 0, "silent before its frame");
        Check(Largest(engine, 1000) > 0.4, "sounds");
        Check(play.State == PlayState.Playing && Math.Abs(play.Position - 0.125) < 0.01, "position");
        play.Set(Control.Pan, 1);
        Largest(engine, 1000);
        Check(Largest(engine, 1000, 2, 0) == 0, "left is silent");
        engine.SetActuatorGain(1, 0);
        Largest(engine, 1000);
        Check(Largest(engine, 1000) == 0, "the gain of the actuator is 0");
        engine.SetActuatorGain(1, 1);
        clip.Reload(Encoding.UTF8.GetBytes(Hum.Replace("0.5", "0.1")));
        Largest(engine, 1000);
        float faint = Largest(engine, 1000);
        Check(faint > 0.05 && faint < 0.15, "the other content plays");
        play.Set(Control.Noise, 0.5);
        play.Set(Control.Events, 0.5);
        engine.SetGroup(0, Control.Tones, 0); // all that is in this clip
        Largest(engine, 1000);
        Check(Largest(engine, 1000) == 0, "the fader is down");
        play.Seek(0.5);
        play.Pause(0.01);
        Largest(engine, 1000);
        Check(play.State == PlayState.Paused, "paused");
        play.Resume(0.01);
        Largest(engine, 1000);
        Check(play.State == PlayState.Playing, "resumed");
        Check(engine.Info.Playing == 1 && engine.Info.Frame == 12000 && engine.Info.Latency == 8, "info of the engine");
        engine.SetBudget(0, 512, 1);
        Check(engine.Calibrate(2.5) == 2.5, "calibrate");
        var second = engine.Play(clip, new PlaySettings { Priority = 5 });
        Largest(engine, 100);
        Check(second.State == PlayState.LeftOut && engine.Info.LeftOut == 1, "left out");
        play.Stop(0.01);
        engine.StopGroup(0);
        Largest(engine, 1000);
        Check(play.State == PlayState.Ended, "ended");

        Throws(Result.Stale, "play: has ended", () => play.Set(Control.Gain, 1));
        play.Dispose();
        Throws(Result.Invalid, "loop", () => engine.Play(clip, new PlaySettings { Loop = 5 }));
        Throws(Result.Invalid, "'lra-176' is no profile", () => new Engine("lra-176"));
        Throws(Result.Invalid, "ActuatorCount: must be 1 to 16", () => new Engine(new string[17]));
        Throws(Result.Io, "dört/none", () => Clip.Load("dört/none"));
        Throws(Result.BadData, "is not a clip", () => Clip.FromBytes(new byte[] { 1, 2, 3, 4 }));
        clip.Dispose();
        clip.Dispose();
        Throws(Result.Stale, "clip is not in use", () => engine.Play(clip));
        engine.Dispose();
        Throws(Result.Stale, "engine is not in use", () => engine.Play(clip));
        Throws(Result.Stale, "engine of the play is not in use", () => play.Stop());
        Throws(Result.Stale, "engine of the play is not in use", () => Console.WriteLine(play.Position));
        Check(play.State == PlayState.Ended, "it has ended with its engine");
        var left = new float[] { 1, 1 };
        Check(!engine.Render(left, 1) && left[0] == 0 && left[1] == 0, "an engine that is disposed is silent");
        for (int i = 0; i < 200; ++i) // more than there can be at a time: they are collected
        {
            new Engine(new EngineConfig { SampleRate = 8000, MaxPlays = 4 });
            if (i % 20 == 19)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
            }
        }
    }

    static void RenderingAllocatesNothing()
    {
        using (var clip = Clip.FromBytes(Encoding.UTF8.GetBytes(Hum)))
        using (var engine = new Engine(new EngineConfig { SampleRate = 8000 }))
        {
            engine.Play(clip, new PlaySettings { Loop = -1 });
            var samples = new float[2];
            engine.Render(samples, 1);
            int before = GC.CollectionCount(0);
            for (int i = 0; i < 500000; ++i) // 16 bytes each would fill the youngest generation, 4 MB, twice
                engine.Render(samples, 1);
            Check(GC.CollectionCount(0) == before, "rendering allocates");
        }
    }

    static void Main(string[] arguments)
    {
        if (arguments.Length == 0)
        {
            Everything();
            RenderingAllocatesNothing();
        }
        else if (arguments[0] == "layout")
            Layout();
        else
            Scene(arguments[1]);
    }
}
