// As much of Unity's classes as the components use, to compile and run them without Unity.
using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public sealed class AddComponentMenu : Attribute { public AddComponentMenu(string name) { } }
    public sealed class TooltipAttribute : Attribute { public TooltipAttribute(string text) { } }
    public sealed class RangeAttribute : Attribute { public RangeAttribute(float from, float to) { } }
    public sealed class HideInInspector : Attribute { }
    public sealed class SerializeField : Attribute { }

    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }

    public class Object { }
    public class Component : Object { public readonly Transform transform = new Transform(); }
    public class MonoBehaviour : Component { }

    public class Transform
    {
        public Vector3 position;
        /// Without rotation and scale.
        public Vector3 InverseTransformPoint(Vector3 p) { return new Vector3(p.x - position.x, p.y - position.y, p.z - position.z); }
    }

    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject, new() { return new T(); }
    }

    public static class Time { public static float deltaTime = 0.01f; }
    public static class AudioSettings { public static int outputSampleRate = 48000; }
}

namespace UnityEditor.AssetImporters
{
    public sealed class ScriptedImporterAttribute : Attribute { public ScriptedImporterAttribute(int version, string extension) { } }
    public abstract class ScriptedImporter : UnityEngine.Object { public abstract void OnImportAsset(AssetImportContext context); }

    public class AssetImportContext
    {
        public string assetPath;
        public readonly List<string> errors = new List<string>(), warnings = new List<string>();
        public UnityEngine.Object main;
        public void LogImportError(string text) { errors.Add(text); }
        public void LogImportWarning(string text) { warnings.Add(text); }
        public void AddObjectToAsset(string name, UnityEngine.Object added) { }
        public void SetMainObject(UnityEngine.Object made) { main = made; }
    }
}
