// Runs the components as Unity would: imports a clip, wakes them, calls them from frame to frame and on the audio thread.
// Writes a second of the third of four channels to standard output.
using System;
using System.Reflection;
using Pacini;
using UnityEditor.AssetImporters;
using UnityEngine;

static class Components
{
    static void Check(bool holds, string claim)
    {
        if (!holds)
            throw new Exception(claim);
    }

    /// A message of Unity's, to a method that nobody else can call.
    static void Send(object to, string message, params object[] arguments)
    {
        MethodInfo method = to.GetType().GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic);
        Check(method != null, to.GetType().Name + " has no " + message);
        method.Invoke(to, arguments);
    }

    static HapticClip Import(string path, int errors)
    {
        var context = new AssetImportContext { assetPath = path };
        new ClipImporter().OnImportAsset(context);
        Check(context.errors.Count == errors && context.warnings.Count == 0, "errors of " + path);
        return (HapticClip)context.main;
    }

    static float[] Heard(HapticOutput output, int frames, float before)
    {
        var data = new float[4 * frames];
        for (int i = 0; i < data.Length; ++i)
            data[i] = before;
        Send(output, "OnAudioFilterRead", data, 4);
        return data;
    }

    static double Energy(float[] data, int channel)
    {
        double sum = 0;
        for (int i = channel; i < data.Length; i += 4)
            sum += data[i] * data[i];
        return sum;
    }

    static void Main(string[] arguments)
    {
        HapticClip clip = Import(arguments[0], 0);
        Import(arguments[1], 1);

        var output = new HapticOutput();
        Send(output, "Awake");
        var source = new HapticSource { clip = clip, output = output };
        Send(source, "Start");
        var drive = new byte[4 * 48128];
        int written = 0;
        foreach (int frames in new[] { 1024, 999, 25, 256, 40000, 48128 - 42304 }) // whatever Unity asks for
        {
            float[] data = Heard(output, frames, 0.25f);
            for (int i = 0; i < frames; ++i)
            {
                Check(data[4 * i] == 0.25f && data[4 * i + 1] == 0.25f && data[4 * i + 3] == 0.25f, "the sound stays");
                Buffer.BlockCopy(new[] { data[4 * i + 2] }, 0, drive, 4 * written++, 4);
            }
            Send(source, "Update");
        }
        using (var stdout = Console.OpenStandardOutput())
            stdout.Write(drive, 0, drive.Length);
        Check(!source.IsPlaying, "it has ended");
        Send(source, "Update");
        Send(source, "OnDisable");
        Send(output, "OnDestroy");

        // From left to right, in a loop, as strong as asked.
        output = new HapticOutput { profiles = new string[] { null, null } };
        Send(output, "Awake");
        output.transform.position = new Vector3(5, 0, 0);
        source = new HapticSource { clip = clip, output = output, loop = true, playOnAwake = false, priority = 3 };
        source.transform.position = new Vector3(2, 1, 0);
        Send(source, "Start");
        Check(!source.IsPlaying, "waits until it is asked");
        source.Play();
        float[] heard = Heard(output, 48000, 0);
        Check(Energy(heard, 2) > 1 && Energy(heard, 3) == 0, "it is to the left");
        source.transform.position = new Vector3(9, 1, 0);
        Send(source, "Update");
        Heard(output, 4800, 0);
        heard = Heard(output, 48000, 0);
        double right = Energy(heard, 3);
        Check(Energy(heard, 2) == 0 && right > 1, "it is to the right");
        source.intensity = 0.5f;
        Send(source, "Update");
        Heard(output, 52800 - 4800, 0);
        heard = Heard(output, 48000, 0);
        Check(Energy(heard, 3) < 0.6 * right, "it is fainter");
        Check(source.IsPlaying, "it goes on");
        source.Play();
        source.Stop();
        Heard(output, 9600, 0);
        Check(!source.IsPlaying && Energy(Heard(output, 9600, 0), 3) == 0, "it has stopped");
        Send(output, "OnDestroy");
        Check(!source.IsPlaying, "no engine, nothing plays");
        Send(source, "Update");
        Send(clip, "OnDisable");
    }
}
