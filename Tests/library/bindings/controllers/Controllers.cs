// Plays short.json on the first controller and prints what happens; then with the component for Unity.
using System;
using System.Reflection;
using System.Threading;
using Pacini;

static class Controllers
{
    static void Check(bool holds, string claim)
    {
        if (!holds)
            throw new Exception(claim);
    }

    static void Send(object to, string message, params object[] arguments)
    {
        to.GetType().GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(to, arguments);
    }

    static void Main()
    {
        var controllers = Controller.Find();
        Check(controllers.Count == 1, "one controller");
        Console.WriteLine("{0}\t{1}\t{2}", controllers[0].Name, controllers[0].Haptics, controllers[0].Connection);
        using (var engine = new Engine(new EngineConfig(null, null)))
        using (var clip = Clip.Load("short.json"))
        {
            engine.Attach(controllers[0]);
            Check(!engine.Render(new float[8], 2), "it is pulled");
            var play = engine.Play(clip);
            while (play.State != PlayState.Ended)
                Thread.Sleep(10);
            var attachment = engine.Attachment;
            Check(attachment.Sent > 20 && attachment.Failure == "", "reports");
            Console.WriteLine(attachment.State);
            engine.Detach();
            Console.WriteLine(engine.Attachment.State);
            Check(engine.Render(new float[8], 2), "the engine is the caller's again");
            try
            {
                engine.Detach();
                Check(false, "detached twice");
            }
            catch (PaciniException error)
            {
                Check(error.Result == Result.Invalid, error.Message);
            }
        }

        var output = new HapticOutput { onController = true };
        Send(output, "Awake");
        Check(output.Engine.Attachment.State == AttachmentState.Attached, "the component has attached it");
        var data = new float[] { 0.25f, 0.25f, 0.25f, 0.25f };
        Send(output, "OnAudioFilterRead", data, 4);
        Check(data[2] == 0.25f, "the sound stays");
        Send(output, "OnDestroy");
    }
}
