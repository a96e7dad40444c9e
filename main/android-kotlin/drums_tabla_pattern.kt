import android.os.Build
import android.os.VibrationEffect
import android.os.Vibrator

fun vibrationOfDrumsTablaPattern(vibrator: Vibrator): VibrationEffect {
    if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
        return VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(200.27f)
            .addControlPoint(0.0062f, 200.27f, 1)
            .addControlPoint(0.5858f, 200.27f, 9)
            .addControlPoint(0.7654f, 200.27f, 5)
            .addControlPoint(0.6811f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 10)
            .addControlPoint(0.4911f, 200.27f, 10)
            .addControlPoint(0.4483f, 200.27f, 20)
            .addControlPoint(0.4067f, 200.27f, 20)
            .addControlPoint(0.3651f, 200.27f, 20)
            .addControlPoint(0.3234f, 200.27f, 20)
            .addControlPoint(0.2298f, 200.27f, 45)
            .addControlPoint(0.3002f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 5)
            .addControlPoint(0.3431f, 200.27f, 10)
            .addControlPoint(0.3201f, 200.27f, 10)
            .addControlPoint(0.2741f, 200.27f, 20)
            .addControlPoint(0.2626f, 200.27f, 5)
            .addControlPoint(0.239f, 200.27f, 15)
            .addControlPoint(0.1759f, 200.27f, 40)
            .addControlPoint(0.1527f, 200.27f, 20)
            .addControlPoint(0.1294f, 200.27f, 20)
            .addControlPoint(0.1178f, 200.27f, 10)
            .addControlPoint(0.201f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 5)
            .addControlPoint(0.3431f, 200.27f, 15)
            .addControlPoint(0.2476f, 200.27f, 40)
            .addControlPoint(0.1998f, 200.27f, 20)
            .addControlPoint(0.1759f, 200.27f, 10)
            .addControlPoint(0.1363f, 200.27f, 30)
            .addControlPoint(0.1099f, 200.27f, 20)
            .addControlPoint(0.0901f, 200.27f, 15)
            .addControlPoint(0.103f, 200.27f, 5)
            .addControlPoint(0.3002f, 200.27f, 5)
            .addControlPoint(0.3922f, 200.27f, 5)
            .addControlPoint(0.311f, 200.27f, 10)
            .addControlPoint(0.2298f, 200.27f, 10)
            .addControlPoint(0.2086f, 200.27f, 10)
            .addControlPoint(0.1663f, 200.27f, 20)
            .addControlPoint(0.1346f, 200.27f, 15)
            .addControlPoint(0.069f, 200.27f, 65)
            .addControlPoint(0.056f, 200.27f, 20)
            .addControlPoint(0.0528f, 200.27f, 5)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 5)
            .addControlPoint(0.3922f, 200.27f, 20)
            .addControlPoint(0.3627f, 200.27f, 20)
            .addControlPoint(0.3331f, 200.27f, 20)
            .addControlPoint(0.2446f, 200.27f, 60)
            .addControlPoint(0.2298f, 200.27f, 10)
            .addControlPoint(0.2183f, 200.27f, 10)
            .addControlPoint(0.201f, 200.27f, 15)
            .addControlPoint(0.3934f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 5)
            .addControlPoint(0.3431f, 200.27f, 10)
            .addControlPoint(0.3269f, 200.27f, 5)
            .addControlPoint(0.2298f, 200.27f, 30)
            .addControlPoint(0.216f, 200.27f, 10)
            .addControlPoint(0.1883f, 200.27f, 20)
            .addControlPoint(0.1607f, 200.27f, 20)
            .addControlPoint(0.1538f, 200.27f, 5)
            .addControlPoint(0.1386f, 200.27f, 15)
            .addControlPoint(0.1182f, 200.27f, 20)
            .addControlPoint(0.103f, 200.27f, 15)
            .addControlPoint(0.1346f, 200.27f, 5)
            .addControlPoint(0.4483f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 5)
            .addControlPoint(0.4887f, 200.27f, 10)
            .addControlPoint(0.3431f, 200.27f, 15)
            .addControlPoint(0.335f, 200.27f, 5)
            .addControlPoint(0.3026f, 200.27f, 20)
            .addControlPoint(0.2703f, 200.27f, 20)
            .addControlPoint(0.2379f, 200.27f, 20)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.201f, 200.27f, 60)
            .addControlPoint(0.3922f, 200.27f, 5)
            .addControlPoint(0.6696f, 200.27f, 5)
            .addControlPoint(0.6327f, 200.27f, 5)
            .addControlPoint(0.4852f, 200.27f, 20)
            .addControlPoint(0.4483f, 200.27f, 5)
            .addControlPoint(0.34f, 200.27f, 35)
            .addControlPoint(0.2626f, 200.27f, 25)
            .addControlPoint(0.2462f, 200.27f, 15)
            .addControlPoint(0.2298f, 200.27f, 15)
            .addControlPoint(0.2189f, 200.27f, 5)
            .addControlPoint(0.1755f, 200.27f, 20)
            .addControlPoint(0.1538f, 200.27f, 10)
            .addControlPoint(0.201f, 200.27f, 5)
            .addControlPoint(0.4483f, 200.27f, 5)
            .addControlPoint(0.2735f, 200.27f, 20)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.2074f, 200.27f, 15)
            .addControlPoint(0.1775f, 200.27f, 20)
            .addControlPoint(0.1178f, 200.27f, 40)
            .addControlPoint(0.0823f, 200.27f, 40)
            .addControlPoint(0.069f, 200.27f, 15)
            .addControlPoint(0.069f, 200.27f, 5)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 5)
            .addControlPoint(0.3002f, 200.27f, 10)
            .addControlPoint(0.201f, 200.27f, 15)
            .addControlPoint(0.1936f, 200.27f, 5)
            .addControlPoint(0.1345f, 200.27f, 40)
            .addControlPoint(0.1049f, 200.27f, 20)
            .addControlPoint(0.0901f, 200.27f, 10)
            .addControlPoint(0.0813f, 200.27f, 10)
            .addControlPoint(0.0638f, 200.27f, 20)
            .addControlPoint(0.0462f, 200.27f, 20)
            .addControlPoint(0.0528f, 200.27f, 5)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 5)
            .addControlPoint(0.3922f, 200.27f, 10)
            .addControlPoint(0.3615f, 200.27f, 10)
            .addControlPoint(0.3002f, 200.27f, 20)
            .addControlPoint(0.2785f, 200.27f, 20)
            .addControlPoint(0.2569f, 200.27f, 20)
            .addControlPoint(0.2352f, 200.27f, 20)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.1879f, 200.27f, 35)
            .addControlPoint(0.1759f, 200.27f, 10)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.4483f, 200.27f, 5)
            .addControlPoint(0.3002f, 200.27f, 25)
            .addControlPoint(0.2362f, 200.27f, 35)
            .addControlPoint(0.1996f, 200.27f, 20)
            .addControlPoint(0.1538f, 200.27f, 25)
            .addControlPoint(0.144f, 200.27f, 15)
            .addControlPoint(0.1309f, 200.27f, 20)
            .addControlPoint(0.1178f, 200.27f, 20)
            .addControlPoint(0.5858f, 200.27f, 10)
            .addControlPoint(0.5308f, 200.27f, 10)
            .addControlPoint(0.4483f, 200.27f, 15)
            .addControlPoint(0.3963f, 200.27f, 25)
            .addControlPoint(0.3547f, 200.27f, 20)
            .addControlPoint(0.313f, 200.27f, 20)
            .addControlPoint(0.2298f, 200.27f, 40)
            .addControlPoint(0.2081f, 200.27f, 20)
            .addControlPoint(0.1647f, 200.27f, 40)
            .addControlPoint(0.1538f, 200.27f, 10)
            .addControlPoint(0.103f, 200.27f, 65)
            .addControlPoint(0.092f, 200.27f, 25)
            .addControlPoint(0.0832f, 200.27f, 20)
            .addControlPoint(0.0789f, 200.27f, 10)
            .addControlPoint(0.1538f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 5)
            .addControlPoint(0.6696f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 15)
            .addControlPoint(0.3922f, 200.27f, 30)
            .addControlPoint(0.371f, 200.27f, 10)
            .addControlPoint(0.201f, 200.27f, 80)
            .addControlPoint(0.1567f, 200.27f, 40)
            .addControlPoint(0.1346f, 200.27f, 20)
            .addControlPoint(0.0789f, 200.27f, 65)
            .addControlPoint(0.0702f, 200.27f, 15)
            .addControlPoint(0.0586f, 200.27f, 20)
            .addControlPoint(0.0528f, 200.27f, 10)
            .addControlPoint(0.0484f, 200.27f, 10)
            .addControlPoint(0.0462f, 200.27f, 5)
            .addControlPoint(0.2298f, 200.27f, 5)
            .addControlPoint(0.8749f, 200.27f, 10)
            .addControlPoint(0.5125f, 200.27f, 20)
            .addControlPoint(0.4483f, 200.27f, 30)
            .addControlPoint(0.4264f, 200.27f, 10)
            .addControlPoint(0.2954f, 200.27f, 60)
            .addControlPoint(0.2517f, 200.27f, 20)
            .addControlPoint(0.2298f, 200.27f, 10)
            .addControlPoint(0.3002f, 200.27f, 5)
            .addControlPoint(0.4483f, 200.27f, 5)
            .addControlPoint(0.3298f, 200.27f, 20)
            .addControlPoint(0.3002f, 200.27f, 5)
            .addControlPoint(0.2308f, 200.27f, 35)
            .addControlPoint(0.201f, 200.27f, 15)
            .addControlPoint(0.3246f, 200.27f, 5)
            .addControlPoint(0.4483f, 200.27f, 5)
            .addControlPoint(0.3369f, 200.27f, 15)
            .addControlPoint(0.2626f, 200.27f, 10)
            .addControlPoint(0.2433f, 200.27f, 10)
            .addControlPoint(0.2048f, 200.27f, 20)
            .addControlPoint(0.1759f, 200.27f, 15)
            .addControlPoint(0.201f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 10)
            .addControlPoint(0.3922f, 200.27f, 15)
            .addControlPoint(0.2659f, 200.27f, 35)
            .addControlPoint(0.2298f, 200.27f, 10)
            .addControlPoint(0.2139f, 200.27f, 10)
            .addControlPoint(0.1505f, 200.27f, 40)
            .addControlPoint(0.1346f, 200.27f, 10)
            .addControlPoint(0.1219f, 200.27f, 10)
            .addControlPoint(0.0965f, 200.27f, 20)
            .addControlPoint(0.0901f, 200.27f, 5)
            .addControlPoint(0.3002f, 200.27f, 5)
            .addControlPoint(0.6696f, 200.27f, 5)
            .addControlPoint(0.7654f, 200.27f, 5)
            .addControlPoint(0.5125f, 200.27f, 15)
            .addControlPoint(0.4975f, 200.27f, 5)
            .addControlPoint(0.4373f, 200.27f, 20)
            .addControlPoint(0.3922f, 200.27f, 15)
            .addControlPoint(0.381f, 200.27f, 5)
            .addControlPoint(0.291f, 200.27f, 40)
            .addControlPoint(0.201f, 200.27f, 40)
            .addControlPoint(0.1346f, 200.27f, 60)
            .addControlPoint(0.0789f, 200.27f, 20)
            .addControlPoint(0f, 200.27f, 1)
            .build()
    }
    return VibrationEffect.createWaveform(
        longArrayOf(
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 20, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10
        ),
        intArrayOf(
            75, 195, 152, 128, 123, 117, 112, 106, 101, 96, 90, 85,
            80, 75, 69, 64, 59, 131, 109, 85, 79, 73, 67, 63,
            59, 55, 51, 47, 43, 40, 37, 34, 32, 51, 149, 108,
            84, 78, 72, 66, 60, 54, 48, 43, 40, 36, 33, 30,
            26, 23, 77, 90, 69, 56, 51, 45, 40, 34, 32, 29,
            27, 24, 21, 19, 17, 15, 13, 131, 137, 112, 98, 94,
            91, 87, 83, 79, 76, 72, 68, 64, 60, 57, 54, 51,
            149, 87, 79, 71, 63, 57, 53, 50, 46, 43, 39, 37,
            34, 31, 29, 26, 114, 137, 112, 87, 83, 79, 75, 71,
            67, 63, 59, 57, 56, 55, 54, 52, 51, 171, 152, 133,
            114, 106, 99, 91, 83, 75, 67, 64, 61, 59, 53, 48,
            42, 51, 103, 81, 59, 55, 51, 47, 43, 40, 36, 32,
            29, 27, 24, 22, 20, 18, 59, 104, 68, 51, 47, 44,
            40, 36, 32, 29, 25, 22, 20, 17, 15, 13, 149, 125,
            96, 88, 80, 75, 72, 70, 67, 64, 61, 59, 56, 52,
            49, 46, 59, 107, 92, 77, 72, 67, 63, 58, 53, 49,
            44, 39, 38, 36, 34, 33, 31, 90, 142, 128, 114, 109,
            104, 98, 93, 88, 82, 77, 72, 67, 61, 57, 54, 52,
            49, 46, 43, 41, 38, 36, 34, 32, 30, 28, 26, 25,
            24, 23, 22, 21, 39, 171, 144, 126, 115, 105, 97, 92,
            86, 81, 76, 70, 65, 59, 54, 50, 47, 44, 41, 39,
            36, 33, 31, 29, 27, 24, 22, 20, 19, 17, 16, 14,
            13, 12, 141, 200, 154, 128, 123, 117, 112, 106, 100, 95,
            89, 84, 78, 73, 67, 61, 77, 107, 92, 77, 71, 66,
            61, 56, 51, 114, 95, 76, 65, 60, 55, 50, 45, 100,
            133, 100, 91, 82, 72, 63, 57, 53, 48, 44, 40, 36,
            33, 29, 26, 23, 171, 174, 131, 123, 115, 108, 100, 94,
            89, 83, 77, 71, 66, 60, 54, 50, 47, 44, 41, 39,
            36, 31, 24
        ),
        -1
    )
}
