// Actuators on channels of Unity's sound output, or a game controller. Beside the AudioListener, or an AudioSource: it adds to what is heard.
//
// SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Pacini
{
    [AddComponentMenu("Pacini/Haptic Output")]
    public sealed class HapticOutput : MonoBehaviour
    {
        [Tooltip("A profile for each actuator, from left to right; empty: the drive signal as it is")]
        public string[] profiles = { "lra-175" };

        [Tooltip("Of the sound output, from 0: that of the first actuator. 2 leaves left and right to the sound.")]
        public int firstChannel = 2;

        [Tooltip("Plays on the first game controller that is connected when this wakes, and not on the sound output")]
        public bool onController;

        private Engine engine;
        private const int blockFrames = 256;
        private float[] block; // [audio]

        /// <summary>Lives as long as this component is awake.</summary>
        public Engine Engine { get { return engine; } }

        private void Awake()
        {
            block = new float[blockFrames * Math.Max(1, profiles.Length)];
            engine = new Engine(new EngineConfig(profiles) { SampleRate = AudioSettings.outputSampleRate });
            if (!onController)
                return;
            var controllers = Controller.Find();
            if (controllers.Count > 0)
                engine.Attach(controllers[0]);
        }

        private void OnDestroy()
        {
            if (engine != null)
                engine.Dispose(); // waits for the audio thread
            engine = null;
        }

        /// <summary>Called by Unity on its audio thread: neither allocates nor waits.</summary>
        private void OnAudioFilterRead(float[] data, int channels)
        {
            Engine playing = engine;
            if (playing == null || channels < 1 || onController)
                return;
            int actuators = block.Length / blockFrames, frames = data.Length / channels;
            int played = Math.Min(actuators, channels - firstChannel);
            for (int done = 0; done < frames; done += blockFrames)
            {
                int n = Math.Min(blockFrames, frames - done);
                playing.Render(block, actuators, n);
                for (int i = 0; i < n; ++i)
                    for (int a = 0; a < played; ++a)
                        data[(done + i) * channels + firstChannel + a] += block[i * actuators + a];
            }
        }
    }
}
