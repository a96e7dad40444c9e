// A clip as an asset of Unity; the importer of .pacb makes them.
//
// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Pacini
{
    public sealed class HapticClip : ScriptableObject
    {
        [SerializeField, HideInInspector] private byte[] bytes;
        private Clip clip;

        /// <summary>The clip in memory, loaded when it is first asked for.</summary>
        public Clip Clip
        {
            get
            {
                if (clip == null)
                    clip = Clip.FromBytes(bytes);
                return clip;
            }
        }

        /// <summary>Puts other content in its place; what plays of it fades over.</summary>
        public void SetBytes(byte[] value)
        {
            if (clip != null)
                clip.Reload(value);
            bytes = value;
        }

        private void OnDisable()
        {
            if (clip != null)
                clip.Dispose();
            clip = null;
        }
    }
}
