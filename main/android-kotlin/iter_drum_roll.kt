import android.os.Build
import android.os.VibrationEffect
import android.os.Vibrator

fun vibrationOfIterDrumRoll(vibrator: Vibrator): VibrationEffect {
    if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
        return VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(224.8f)
            .addControlPoint(0f, 224.8f, 5)
            .addControlPoint(0.0207f, 224.8f, 5)
            .addControlPoint(0.3431f, 224.8f, 5)
            .addControlPoint(0.5125f, 224.8f, 5)
            .addControlPoint(0.5125f, 224.8f, 35)
            .addControlPoint(0.6696f, 224.8f, 5)
            .addControlPoint(0.6909f, 224.8f, 20)
            .addControlPoint(0.7335f, 224.8f, 40)
            .addControlPoint(0.7548f, 224.8f, 20)
            .addControlPoint(0.7654f, 224.8f, 10)
            .addControlPoint(0.5858f, 224.8f, 25)
            .addControlPoint(0.7654f, 224.8f, 15)
            .addControlPoint(0.7092f, 224.8f, 10)
            .addControlPoint(0.5968f, 224.8f, 20)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.5369f, 224.8f, 5)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.5696f, 224.8f, 10)
            .addControlPoint(0.4726f, 224.8f, 60)
            .addControlPoint(0.4483f, 224.8f, 15)
            .addControlPoint(0.5221f, 224.8f, 5)
            .addControlPoint(0.6696f, 224.8f, 10)
            .addControlPoint(0.5125f, 224.8f, 35)
            .addControlPoint(0.6696f, 224.8f, 15)
            .addControlPoint(0.5798f, 224.8f, 20)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.5649f, 224.8f, 5)
            .addControlPoint(0.6696f, 224.8f, 10)
            .addControlPoint(0.6172f, 224.8f, 10)
            .addControlPoint(0.5125f, 224.8f, 20)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.4712f, 224.8f, 50)
            .addControlPoint(0.4483f, 224.8f, 10)
            .addControlPoint(0.6696f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 35)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.5492f, 224.8f, 15)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.5858f, 224.8f, 15)
            .addControlPoint(0.5664f, 224.8f, 10)
            .addControlPoint(0.489f, 224.8f, 40)
            .addControlPoint(0.3922f, 224.8f, 50)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.4323f, 224.8f, 20)
            .addControlPoint(0.3922f, 224.8f, 10)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.3922f, 224.8f, 25)
            .addControlPoint(0.5125f, 224.8f, 35)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 60)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 40)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5858f, 224.8f, 20)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.3922f, 224.8f, 35)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.3922f, 224.8f, 35)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.3431f, 224.8f, 40)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.3922f, 224.8f, 35)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5858f, 224.8f, 25)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5858f, 224.8f, 15)
            .addControlPoint(0.5033f, 224.8f, 15)
            .addControlPoint(0.4483f, 224.8f, 10)
            .addControlPoint(0.5125f, 224.8f, 30)
            .addControlPoint(0.4483f, 224.8f, 20)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.4483f, 224.8f, 20)
            .addControlPoint(0.5125f, 224.8f, 40)
            .addControlPoint(0.3922f, 224.8f, 25)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.4884f, 224.8f, 10)
            .addControlPoint(0.3922f, 224.8f, 40)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.3922f, 224.8f, 25)
            .addControlPoint(0.5125f, 224.8f, 30)
            .addControlPoint(0.4483f, 224.8f, 35)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.3922f, 224.8f, 35)
            .addControlPoint(0.5858f, 224.8f, 15)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5125f, 224.8f, 10)
            .addControlPoint(0.4541f, 224.8f, 50)
            .addControlPoint(0.4483f, 224.8f, 5)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 35)
            .addControlPoint(0.54f, 224.8f, 10)
            .addControlPoint(0.5858f, 224.8f, 5)
            .addControlPoint(0.5171f, 224.8f, 15)
            .addControlPoint(0.4483f, 224.8f, 15)
            .addControlPoint(0.4941f, 224.8f, 5)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.5125f, 224.8f, 15)
            .addControlPoint(0.4483f, 224.8f, 25)
            .addControlPoint(0.5858f, 224.8f, 30)
            .addControlPoint(0.523f, 224.8f, 30)
            .addControlPoint(0.5125f, 224.8f, 5)
            .addControlPoint(0.6696f, 224.8f, 10)
            .addControlPoint(0.6419f, 224.8f, 5)
            .addControlPoint(0.4483f, 224.8f, 35)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 30)
            .addControlPoint(0.4941f, 224.8f, 5)
            .addControlPoint(0.5858f, 224.8f, 10)
            .addControlPoint(0.4483f, 224.8f, 25)
            .addControlPoint(0.4655f, 224.8f, 5)
            .addControlPoint(0.5858f, 224.8f, 35)
            .addControlPoint(0.4483f, 224.8f, 25)
            .addControlPoint(0.5858f, 224.8f, 15)
            .addControlPoint(0.4648f, 224.8f, 25)
            .addControlPoint(0.3922f, 224.8f, 15)
            .addControlPoint(0.489f, 224.8f, 5)
            .addControlPoint(0.5858f, 224.8f, 5)
            .addControlPoint(0.5342f, 224.8f, 15)
            .addControlPoint(0.4483f, 224.8f, 25)
            .addControlPoint(0.3002f, 224.8f, 15)
            .addControlPoint(0f, 224.8f, 1)
            .build()
    }
    return VibrationEffect.createWaveform(
        longArrayOf(
            10, 10, 40, 10, 10, 10, 10, 10, 10, 10, 10, 10,
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
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 20, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 20,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
            10, 10, 10, 10, 10
        ),
        intArrayOf(
            0, 87, 131, 172, 175, 178, 180, 183, 186, 188, 191, 194,
            186, 168, 149, 180, 188, 174, 159, 145, 131, 143, 147, 143,
            139, 135, 131, 127, 123, 118, 114, 152, 165, 154, 142, 131,
            157, 165, 154, 142, 131, 157, 164, 151, 137, 140, 146, 141,
            135, 129, 123, 117, 143, 163, 147, 130, 114, 149, 143, 137,
            131, 143, 147, 142, 137, 132, 127, 122, 117, 112, 107, 102,
            115, 126, 115, 105, 115, 125, 112, 100, 109, 118, 126, 128,
            123, 117, 123, 129, 127, 124, 121, 118, 116, 132, 145, 136,
            127, 119, 132, 144, 132, 120, 123, 141, 144, 132, 120, 123,
            126, 118, 109, 100, 131, 122, 113, 104, 110, 131, 120, 109,
            98, 87, 116, 126, 118, 109, 100, 131, 125, 120, 114, 128,
            142, 144, 132, 120, 126, 149, 135, 121, 117, 123, 128, 127,
            118, 120, 131, 123, 114, 118, 123, 127, 131, 118, 106, 115,
            128, 121, 115, 109, 103, 110, 131, 125, 120, 114, 125, 112,
            100, 110, 120, 131, 126, 121, 117, 132, 142, 128, 114, 100,
            133, 144, 132, 120, 123, 129, 126, 123, 120, 117, 114, 149,
            139, 129, 119, 126, 149, 138, 126, 114, 138, 144, 132, 120,
            131, 124, 118, 120, 132, 144, 147, 141, 136, 131, 171, 157,
            143, 128, 114, 149, 138, 126, 114, 138, 142, 128, 114, 123,
            132, 141, 149, 135, 121, 126, 149, 137, 125, 112, 100, 149,
            141, 132, 123, 114, 89
        ),
        -1
    )
}
