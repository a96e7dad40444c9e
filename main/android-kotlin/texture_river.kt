import android.os.Build
import android.os.VibrationEffect
import android.os.Vibrator

fun vibrationOfTextureRiver(vibrator: Vibrator): VibrationEffect {
    if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
        return VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(212.18f)
            .addControlPoint(0.0271f, 212.18f, 1)
            .addControlPoint(0.4483f, 212.18f, 14)
            .addControlPoint(0.5858f, 212.18f, 5)
            .addControlPoint(0.4483f, 212.18f, 15)
            .addControlPoint(0.5036f, 212.18f, 5)
            .addControlPoint(0.6696f, 212.18f, 15)
            .addControlPoint(0.5911f, 212.18f, 5)
            .addControlPoint(0.5125f, 212.18f, 5)
            .addControlPoint(0.5125f, 212.18f, 15)
            .addControlPoint(0.5125f, 212.18f, 20)
            .addControlPoint(0.5125f, 212.18f, 35)
            .addControlPoint(0.5998f, 212.18f, 25)
            .addControlPoint(0.6696f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 45)
            .addControlPoint(0.6696f, 212.18f, 15)
            .addControlPoint(0.5858f, 212.18f, 35)
            .addControlPoint(0.5858f, 212.18f, 60)
            .addControlPoint(0.5125f, 212.18f, 5)
            .addControlPoint(0.6696f, 212.18f, 30)
            .addControlPoint(0.651f, 212.18f, 10)
            .addControlPoint(0.6137f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 15)
            .addControlPoint(0.6696f, 212.18f, 20)
            .addControlPoint(0.6613f, 212.18f, 5)
            .addControlPoint(0.6283f, 212.18f, 20)
            .addControlPoint(0.5952f, 212.18f, 20)
            .addControlPoint(0.5621f, 212.18f, 20)
            .addControlPoint(0.5125f, 212.18f, 30)
            .addControlPoint(0.5238f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 55)
            .addControlPoint(0.5451f, 212.18f, 25)
            .addControlPoint(0.5125f, 212.18f, 20)
            .addControlPoint(0.6811f, 212.18f, 20)
            .addControlPoint(0.7654f, 212.18f, 10)
            .addControlPoint(0.6696f, 212.18f, 15)
            .addControlPoint(0.6539f, 212.18f, 15)
            .addControlPoint(0.5858f, 212.18f, 65)
            .addControlPoint(0.6696f, 212.18f, 15)
            .addControlPoint(0.5858f, 212.18f, 15)
            .addControlPoint(0.5797f, 212.18f, 5)
            .addControlPoint(0.5125f, 212.18f, 55)
            .addControlPoint(0.6696f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 15)
            .addControlPoint(0.6696f, 212.18f, 10)
            .addControlPoint(0.6457f, 212.18f, 10)
            .addControlPoint(0.5978f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 5)
            .addControlPoint(0.5858f, 212.18f, 35)
            .addControlPoint(0.5858f, 212.18f, 15)
            .addControlPoint(0.7654f, 212.18f, 15)
            .addControlPoint(0.5858f, 212.18f, 30)
            .addControlPoint(0.5858f, 212.18f, 35)
            .addControlPoint(0.5858f, 212.18f, 5)
            .addControlPoint(0.5858f, 212.18f, 120)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 55)
            .addControlPoint(0.6696f, 212.18f, 15)
            .addControlPoint(0.5125f, 212.18f, 50)
            .addControlPoint(0.6696f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 30)
            .addControlPoint(0.6696f, 212.18f, 10)
            .addControlPoint(0.5987f, 212.18f, 70)
            .addControlPoint(0.5176f, 212.18f, 80)
            .addControlPoint(0.5125f, 212.18f, 5)
            .addControlPoint(0.5125f, 212.18f, 5)
            .addControlPoint(0.5649f, 212.18f, 10)
            .addControlPoint(0.6696f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 15)
            .addControlPoint(0.5858f, 212.18f, 45)
            .addControlPoint(0.5858f, 212.18f, 55)
            .addControlPoint(0.6277f, 212.18f, 5)
            .addControlPoint(0.6696f, 212.18f, 5)
            .addControlPoint(0.5858f, 212.18f, 15)
            .addControlPoint(0.6277f, 212.18f, 20)
            .addControlPoint(0.6696f, 212.18f, 20)
            .addControlPoint(0.7654f, 212.18f, 15)
            .addControlPoint(0.7462f, 212.18f, 5)
            .addControlPoint(0.6696f, 212.18f, 20)
            .addControlPoint(0.6457f, 212.18f, 20)
            .addControlPoint(0.6217f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 30)
            .addControlPoint(0.6696f, 212.18f, 10)
            .addControlPoint(0.5998f, 212.18f, 20)
            .addControlPoint(0.5125f, 212.18f, 25)
            .addControlPoint(0.5858f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 85)
            .addControlPoint(0.5858f, 212.18f, 40)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 45)
            .addControlPoint(0.6696f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 15)
            .addControlPoint(0.6044f, 212.18f, 10)
            .addControlPoint(0.6696f, 212.18f, 35)
            .addControlPoint(0.5858f, 212.18f, 10)
            .addControlPoint(0.5945f, 212.18f, 15)
            .addControlPoint(0.6176f, 212.18f, 40)
            .addControlPoint(0.6291f, 212.18f, 20)
            .addControlPoint(0.6523f, 212.18f, 40)
            .addControlPoint(0.6638f, 212.18f, 20)
            .addControlPoint(0.6696f, 212.18f, 10)
            .addControlPoint(0.6277f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 10)
            .addControlPoint(0.7654f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 10)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.6417f, 212.18f, 30)
            .addControlPoint(0.6696f, 212.18f, 15)
            .addControlPoint(0.5858f, 212.18f, 25)
            .addControlPoint(0.5858f, 212.18f, 60)
            .addControlPoint(0.5858f, 212.18f, 40)
            .addControlPoint(0.5641f, 212.18f, 40)
            .addControlPoint(0.5532f, 212.18f, 20)
            .addControlPoint(0.5315f, 212.18f, 40)
            .addControlPoint(0.5125f, 212.18f, 35)
            .addControlPoint(0.5147f, 212.18f, 5)
            .addControlPoint(0.5325f, 212.18f, 40)
            .addControlPoint(0.568f, 212.18f, 80)
            .addControlPoint(0.5769f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.6696f, 212.18f, 15)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 5)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.5858f, 212.18f, 20)
            .addControlPoint(0.6696f, 212.18f, 5)
            .addControlPoint(0.4483f, 212.18f, 15)
            .addControlPoint(0f, 212.18f, 1)
            .build()
    }
    return VibrationEffect.createWaveform(
        longArrayOf(
            10, 10, 10, 10, 10, 10, 80, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 70, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 20, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 60, 10, 10, 10, 10, 240,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 20, 110, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 220, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 20, 20, 10, 10, 10,
            10, 10, 10, 10, 110, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 70, 10, 10
        ),
        intArrayOf(
            43, 114, 138, 114, 143, 171, 131, 140, 148, 157, 166, 168,
            164, 159, 154, 149, 164, 168, 162, 155, 149, 137, 151, 164,
            168, 164, 159, 154, 149, 160, 171, 167, 162, 158, 154, 150,
            145, 141, 137, 133, 132, 135, 138, 141, 144, 147, 149, 145,
            141, 137, 133, 141, 163, 184, 187, 171, 168, 165, 163, 160,
            157, 155, 152, 149, 164, 149, 146, 143, 140, 137, 134, 131,
            171, 157, 160, 168, 162, 155, 149, 180, 188, 172, 157, 149,
            164, 167, 159, 151, 143, 135, 151, 167, 160, 153, 160, 169,
            167, 164, 162, 159, 157, 154, 151, 149, 146, 144, 141, 138,
            136, 133, 131, 137, 151, 164, 149, 171, 157, 152, 157, 163,
            168, 179, 195, 185, 176, 169, 166, 163, 160, 157, 154, 151,
            160, 166, 157, 148, 140, 131, 149, 171, 157, 152, 157, 161,
            166, 171, 149, 151, 152, 154, 155, 157, 158, 160, 161, 163,
            164, 166, 167, 169, 170, 165, 155, 172, 149, 152, 157, 161,
            166, 171, 162, 154, 149, 147, 146, 145, 143, 142, 140, 139,
            138, 136, 135, 133, 132, 131, 132, 133, 134, 135, 136, 137,
            139, 140, 141, 142, 143, 144, 145, 147, 148, 149, 157, 171,
            160, 149, 171, 133
        ),
        -1
    )
}
