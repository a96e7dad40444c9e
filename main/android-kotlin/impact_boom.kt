import android.os.Build
import android.os.VibrationEffect
import android.os.Vibrator

fun vibrationOfImpactBoom(vibrator: Vibrator): VibrationEffect {
    if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
        return VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(80.635f)
            .addControlPoint(0.0309f, 80.635f, 1)
            .addControlPoint(0.0528f, 80.635f, 4)
            .addControlPoint(0.1178f, 80.635f, 5)
            .addControlPoint(0.5125f, 80.635f, 10)
            .addControlPoint(0.6625f, 60.408f, 20)
            .addControlPoint(0.8125f, 60.408f, 20)
            .addControlPoint(0.9625f, 60.408f, 20)
            .addControlPoint(1f, 60.408f, 5)
            .addControlPoint(0.9752f, 60.408f, 15)
            .addControlPoint(0.9091f, 60.408f, 40)
            .addControlPoint(0.8761f, 60.408f, 20)
            .addControlPoint(0.843f, 60.408f, 20)
            .addControlPoint(0.6778f, 60.408f, 100)
            .addControlPoint(0.6447f, 60.408f, 20)
            .addControlPoint(0.5125f, 60.408f, 80)
            .addControlPoint(0.3698f, 60.408f, 160)
            .addControlPoint(0.3431f, 60.408f, 30)
            .addControlPoint(0.201f, 60.408f, 225)
            .addControlPoint(0.1741f, 60.408f, 85)
            .addControlPoint(0.1346f, 60.408f, 125)
            .addControlPoint(0.0789f, 60.408f, 215)
            .addControlPoint(0.0462f, 60.408f, 210)
            .addControlPoint(0.0384f, 60.408f, 110)
            .addControlPoint(0.0309f, 60.408f, 105)
            .addControlPoint(0.0242f, 60.408f, 15)
            .addControlPoint(0.0061f, 60.408f, 40)
            .addControlPoint(0.0016f, 60.408f, 10)
            .addControlPoint(0.0016f, 60.408f, 4)
            .addControlPoint(0f, 60.408f, 1)
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
            10, 10, 10, 10, 10, 10, 10, 10, 20, 10, 10, 10,
            20, 10, 10, 10, 20, 10, 10, 10, 20, 10, 10, 10,
            20, 10, 20, 10, 20, 10, 20, 10, 20, 10, 20, 10,
            20, 10, 30, 20, 30, 20, 30, 20, 30, 20, 40, 50,
            60, 50, 40, 10, 10, 10, 10, 10, 14
        ),
        intArrayOf(
            13, 80, 140, 159, 179, 198, 217, 236, 255, 251, 247, 242,
            238, 234, 230, 226, 221, 217, 213, 209, 204, 200, 196, 192,
            188, 183, 179, 175, 171, 167, 162, 158, 154, 150, 145, 141,
            137, 133, 130, 127, 125, 123, 120, 118, 116, 114, 111, 109,
            107, 105, 102, 100, 98, 95, 93, 91, 89, 87, 85, 83,
            82, 80, 79, 77, 75, 74, 72, 71, 69, 67, 66, 64,
            63, 61, 59, 58, 56, 54, 53, 51, 50, 49, 48, 47,
            46, 45, 44, 43, 42, 41, 40, 39, 38, 37, 36, 35,
            34, 33, 32, 31, 30, 29, 28, 27, 26, 25, 24, 23,
            22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11,
            10, 9, 8, 7, 6, 4, 3, 2, 1
        ),
        -1
    )
}
