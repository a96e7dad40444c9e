// Makes a HapticClip of each .pacb file in a project of Unity.
//
// SPDX-License-Identifier: MIT
using System;
using System.IO;
using UnityEditor.AssetImporters;
using UnityEngine;

namespace Pacini
{
    [ScriptedImporter(1, "pacb")]
    public sealed class ClipImporter : ScriptedImporter
    {
        public override void OnImportAsset(AssetImportContext context)
        {
            byte[] bytes = File.ReadAllBytes(context.assetPath);
            try
            {
                Clip.FromBytes(bytes).Dispose();
            }
            catch (PaciniException error)
            {
                context.LogImportError(context.assetPath + ": " + error.Message);
            }
            catch (DllNotFoundException)
            {
                context.LogImportWarning(context.assetPath + ": libpacini is not in the project, so the clip is not checked");
            }
            var clip = ScriptableObject.CreateInstance<HapticClip>();
            clip.SetBytes(bytes);
            context.AddObjectToAsset("clip", clip);
            context.SetMainObject(clip);
        }
    }
}
