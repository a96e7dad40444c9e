import android.os.Build
import android.os.VibrationEffect
import android.os.Vibrator

fun vibrationOfKnockWoodBridge(vibrator: Vibrator): VibrationEffect {
    if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
        return VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(85.43f)
            .addControlPoint(0.0353f, 85.43f, 1)
            .addControlPoint(0.1178f, 200.27f, 9)
            .addControlPoint(0.5858f, 200.27f, 10)
            .addControlPoint(0.5125f, 200.27f, 30)
            .addControlPoint(0.3431f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 15)
            .addControlPoint(0.2298f, 152.22f, 20)
            .addControlPoint(0.3431f, 85.43f, 5)
            .addControlPoint(0.1759f, 85.43f, 5)
            .addControlPoint(0.3002f, 85.43f, 10)
            .addControlPoint(0.201f, 85.43f, 5)
            .addControlPoint(0.3002f, 85.43f, 5)
            .addControlPoint(0.1538f, 85.43f, 10)
            .addControlPoint(0.3002f, 85.43f, 5)
            .addControlPoint(0.1346f, 85.43f, 10)
            .addControlPoint(0.2298f, 85.43f, 10)
            .addControlPoint(0.1178f, 85.43f, 5)
            .addControlPoint(0.201f, 85.43f, 10)
            .addControlPoint(0.1178f, 85.43f, 5)
            .addControlPoint(0.2298f, 85.43f, 5)
            .addControlPoint(0.1178f, 85.43f, 10)
            .addControlPoint(0.1538f, 85.43f, 10)
            .addControlPoint(0.0528f, 200.27f, 45)
            .addControlPoint(0.103f, 200.27f, 5)
            .addControlPoint(0.5858f, 200.27f, 10)
            .addControlPoint(0.5012f, 200.27f, 40)
            .addControlPoint(0.4589f, 85.43f, 20)
            .addControlPoint(0.4483f, 85.43f, 5)
            .addControlPoint(0.2298f, 85.43f, 5)
            .addControlPoint(0.3002f, 85.43f, 5)
            .addControlPoint(0.0528f, 85.43f, 180)
            .addControlPoint(0.069f, 85.43f, 5)
            .addControlPoint(0.069f, 85.43f, 4)
            .addControlPoint(0f, 85.43f, 1)
            .build()
    }
    return VibrationEffect.createWaveform(
        longArrayOf(
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 14
        ),
        intArrayOf(
            20, 90, 146, 140, 134, 87, 129, 127, 81, 87, 61, 51,
            58, 77, 34, 59, 41, 30, 44, 35, 36, 31, 25, 19,
            13, 88, 147, 141, 136, 130, 125, 120, 114, 77, 73, 70,
            66, 63, 59, 56, 52, 49, 45, 42, 38, 34, 31, 27,
            24, 20, 17, 15
        ),
        -1
    )
}
