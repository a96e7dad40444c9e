// Plays a haptic clip from where its object is.
//
// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Pacini
{
    [AddComponentMenu("Pacini/Haptic Source")]
    public sealed class HapticSource : MonoBehaviour
    {
        public HapticClip clip;
        public HapticOutput output;
        public bool playOnAwake = true;
        public bool loop;

        [Tooltip("Left and right of the output's object, as in the first and the last actuator; otherwise `pan`")]
        public bool panByPosition = true;
        [Range(0f, 1f)] public float pan = 0.5f;
        [Range(0f, 1f)] public float intensity = 1f;

        [Tooltip("Who is left out first when there is too much; 0 is kept longest")]
        public int priority = 16;
        [Tooltip("0 to 31")] public int group;

        private Play play;

        /// <summary>The newest of what it has started; null before.</summary>
        public Play Current { get { return play; } }

        public bool IsPlaying { get { return play != null && play.State != PlayState.Ended; } }

        private void Start()
        {
            if (playOnAwake)
                Play();
        }

        private void Update()
        {
            if (!IsPlaying)
                return;
            try
            {
                play.Set(Control.Pan, Pan, Time.deltaTime);
                play.Set(Control.Intensity, intensity, Time.deltaTime);
            }
            catch (PaciniException error)
            {
                if (error.Result != Result.Stale) // it has ended meanwhile
                    throw;
            }
        }

        private void OnDisable()
        {
            Stop();
        }

        /// <summary>Starts the clip anew; what it still plays fades out.</summary>
        public void Play()
        {
            Stop();
            play = output.Engine.Play(clip.Clip, new PlaySettings
            {
                Loop = loop ? -1.0 : 0.0,
                Pan = Pan,
                Intensity = intensity,
                Priority = priority,
                Group = group
            });
        }

        public void Stop(float fade = 0.02f)
        {
            if (!IsPlaying)
                return;
            try
            {
                play.Stop(fade);
            }
            catch (PaciniException error)
            {
                if (error.Result != Result.Stale)
                    throw;
            }
        }

        /// <summary>0 where it is to the left of the output, 0.5 before, behind or at it, 1 to the right.</summary>
        private double Pan
        {
            get
            {
                if (!panByPosition)
                    return pan;
                Vector3 at = output.transform.InverseTransformPoint(transform.position);
                double distance = System.Math.Sqrt((double)at.x * at.x + (double)at.z * at.z);
                return distance > 1e-6 ? 0.5 + 0.5 * at.x / distance : 0.5;
            }
        }
    }
}
