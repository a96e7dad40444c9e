#include "io/formats/ForeignText.h"
#include "io/formats/android/AndroidEffects.h"
#include "io/formats/android/AndroidFormat.h"
#include "io/formats/android/AndroidText.h"

#include <fmt/format.h>

#include <utility>

namespace pacini
{

namespace
{
/// A name in camel case, as functions of Kotlin and Java have it.
std::string functionName(const Clip& clip, const ExportParams& params)
{
    std::string name;
    bool upper = true;
    for (const char c : identifierOf(nameOfClip(clip, params.name)))
    {
        if (c == '_')
            upper = true;
        else
        {
            name += upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
            upper = false;
        }
    }
    return "vibrationOf" + name;
}

std::string builderCalls(const std::vector<AndroidPoint>& points)
{
    std::string text;
    for (const AndroidPoint& point : points)
        text += fmt::format("            .addControlPoint({}f, {}f, {})\n", decimal(point.amplitude, 4),
                            decimal(point.frequency, 4), point.duration);
    return text;
}
} // namespace

bool isAndroidKotlin(std::string_view bytes)
{
    return bytes.starts_with("import android.os.Build\nimport android.os.VibrationEffect\n");
}

bool isAndroidJava(std::string_view bytes)
{
    return bytes.starts_with("import android.os.Build;\nimport android.os.VibrationEffect;\n");
}

Result<ExportedClip> writeAndroidKotlin(const Clip& clip, const ExportParams& params)
{
    AndroidExport made = androidEffectsOf(clip, params);
    return oneFile(fmt::format(R"(import android.os.Build
import android.os.VibrationEffect
import android.os.Vibrator

fun {}(vibrator: Vibrator): VibrationEffect {{
    if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {{
        return VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz({}f)
{}            .build()
    }}
    return VibrationEffect.createWaveform(
        longArrayOf({}
        ),
        intArrayOf({}
        ),
        -1
    )
}}
)",
                               functionName(clip, params), decimal(made.effects.envelope.initialFrequency, 4),
                               builderCalls(made.effects.envelope.points),
                               timingsOf(made.effects.waveform, "            "),
                               amplitudesOf(made.effects.waveform, "            ")),
                   std::move(made.losses));
}

Result<ExportedClip> writeAndroidJava(const Clip& clip, const ExportParams& params)
{
    AndroidExport made = androidEffectsOf(clip, params);
    const std::string function = functionName(clip, params);
    std::string type = function;
    type[0] = 'V';
    return oneFile(fmt::format(R"(import android.os.Build;
import android.os.VibrationEffect;
import android.os.Vibrator;

public final class {} {{
    private {}() {{}}

    public static VibrationEffect {}(Vibrator vibrator) {{
        if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {{
            return new VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz({}f)
{}            .build();
        }}
        return VibrationEffect.createWaveform(
            new long[] {{{}
            }},
            new int[] {{{}
            }},
            -1);
    }}
}}
)",
                               type, type, function, decimal(made.effects.envelope.initialFrequency, 4),
                               builderCalls(made.effects.envelope.points),
                               timingsOf(made.effects.waveform, "                "),
                               amplitudesOf(made.effects.waveform, "                ")),
                   std::move(made.losses));
}

} // namespace pacini
