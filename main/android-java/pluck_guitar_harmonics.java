import android.os.Build;
import android.os.VibrationEffect;
import android.os.Vibrator;

public final class VibrationOfPluckGuitarHarmonics {
    private VibrationOfPluckGuitarHarmonics() {}

    public static VibrationEffect vibrationOfPluckGuitarHarmonics(Vibrator vibrator) {
        if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
            return new VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(966.53f)
            .addControlPoint(0.1178f, 966.53f, 1)
            .addControlPoint(0.082f, 966.53f, 19)
            .addControlPoint(0.0462f, 966.53f, 20)
            .addControlPoint(0.0353f, 966.53f, 65)
            .addControlPoint(0.0353f, 966.53f, 35)
            .addControlPoint(0.0353f, 966.53f, 15)
            .addControlPoint(0.0223f, 966.53f, 5)
            .addControlPoint(0.0093f, 275.17f, 5)
            .addControlPoint(0.0024f, 367.3f, 5)
            .addControlPoint(0.0057f, 367.3f, 10)
            .addControlPoint(0.0106f, 654.46f, 15)
            .addControlPoint(0.0207f, 654.46f, 5)
            .addControlPoint(0.0604f, 654.46f, 5)
            .addControlPoint(0.3431f, 654.46f, 5)
            .addControlPoint(0.201f, 654.46f, 10)
            .addControlPoint(0.1123f, 654.46f, 20)
            .addControlPoint(0.0901f, 654.46f, 5)
            .addControlPoint(0.0462f, 654.46f, 20)
            .addControlPoint(0.0318f, 654.46f, 15)
            .addControlPoint(0.0271f, 654.46f, 5)
            .addControlPoint(0.0217f, 654.46f, 15)
            .addControlPoint(0.0181f, 654.46f, 10)
            .addControlPoint(0.0192f, 654.46f, 10)
            .addControlPoint(0.0213f, 166f, 20)
            .addControlPoint(0.0234f, 166f, 20)
            .addControlPoint(0.0255f, 166f, 20)
            .addControlPoint(0.0271f, 490.29f, 15)
            .addControlPoint(0.2377f, 490.29f, 5)
            .addControlPoint(0.4483f, 490.29f, 5)
            .addControlPoint(0.4132f, 490.29f, 15)
            .addControlPoint(0.3665f, 490.29f, 20)
            .addControlPoint(0.3431f, 490.29f, 10)
            .addControlPoint(0.3401f, 490.29f, 10)
            .addControlPoint(0.3342f, 490.29f, 20)
            .addControlPoint(0.3106f, 490.29f, 80)
            .addControlPoint(0.3046f, 490.29f, 20)
            .addControlPoint(0.3002f, 490.29f, 15)
            .addControlPoint(0.3922f, 490.29f, 5)
            .addControlPoint(0.3002f, 490.29f, 65)
            .addControlPoint(0.2927f, 490.29f, 15)
            .addControlPoint(0.2726f, 490.29f, 40)
            .addControlPoint(0.2626f, 490.29f, 20)
            .addControlPoint(0.0789f, 490.29f, 15)
            .addControlPoint(0.0696f, 490.29f, 5)
            .addControlPoint(0.0604f, 490.29f, 5)
            .addControlPoint(0.1346f, 490.29f, 5)
            .addControlPoint(0.5125f, 490.29f, 5)
            .addControlPoint(0.4483f, 490.29f, 5)
            .addControlPoint(0.4296f, 490.29f, 20)
            .addControlPoint(0.4109f, 490.29f, 20)
            .addControlPoint(0.3922f, 490.29f, 20)
            .addControlPoint(0.3529f, 490.29f, 120)
            .addControlPoint(0.3464f, 490.29f, 20)
            .addControlPoint(0.3431f, 490.29f, 10)
            .addControlPoint(0.5125f, 490.29f, 5)
            .addControlPoint(0.4953f, 490.29f, 5)
            .addControlPoint(0.4266f, 490.29f, 20)
            .addControlPoint(0.3922f, 490.29f, 10)
            .addControlPoint(0.3854f, 490.29f, 10)
            .addControlPoint(0.3445f, 490.29f, 60)
            .addControlPoint(0.2899f, 490.29f, 80)
            .addControlPoint(0.2762f, 490.29f, 20)
            .addControlPoint(0.2626f, 490.29f, 20)
            .addControlPoint(0.3922f, 490.29f, 5)
            .addControlPoint(0.3002f, 490.29f, 15)
            .addControlPoint(0.2689f, 490.29f, 20)
            .addControlPoint(0.2376f, 490.29f, 20)
            .addControlPoint(0.2298f, 490.29f, 5)
            .addControlPoint(0.2298f, 490.29f, 15)
            .addControlPoint(0.2298f, 490.29f, 140)
            .addControlPoint(0.179f, 490.29f, 80)
            .addControlPoint(0.1346f, 490.29f, 70)
            .addControlPoint(0.126f, 490.29f, 30)
            .addControlPoint(0.1145f, 490.29f, 40)
            .addControlPoint(0.103f, 490.29f, 40)
            .addControlPoint(0.103f, 490.29f, 40)
            .addControlPoint(0.103f, 490.29f, 145)
            .addControlPoint(0.1006f, 490.29f, 15)
            .addControlPoint(0.069f, 490.29f, 195)
            .addControlPoint(0.0644f, 490.29f, 45)
            .addControlPoint(0.0604f, 490.29f, 40)
            .addControlPoint(0.0543f, 490.29f, 60)
            .addControlPoint(0.0462f, 490.29f, 80)
            .addControlPoint(0.0404f, 490.29f, 220)
            .addControlPoint(0.023f, 490.29f, 240)
            .addControlPoint(0.0081f, 490.29f, 205)
            .addControlPoint(0.0076f, 490.29f, 15)
            .addControlPoint(0.0032f, 490.29f, 120)
            .addControlPoint(0.0009f, 654.46f, 80)
            .addControlPoint(0f, 654.46f, 30)
            .addControlPoint(0f, 654.46f, 5)
            .addControlPoint(0f, 654.46f, 285)
            .addControlPoint(0f, 654.46f, 10)
            .addControlPoint(0f, 654.46f, 2)
            .build();
        }
        return VibrationEffect.createWaveform(
            new long[] {
                10, 10, 10, 10, 10, 20, 20, 70, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 40, 40,
                20, 10, 10, 10, 10, 10, 10, 20, 10, 10, 20, 10,
                10, 20, 10, 10, 20, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 20, 10,
                10, 10, 10, 20, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 160,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 20, 10, 20, 10, 10, 20, 200,
                30, 20, 30, 20, 20, 30, 20, 30, 40, 40, 30, 40,
                40, 70, 150, 70, 60, 50, 60, 50, 50, 60, 50, 90,
                110, 372
            },
            new int[] {
                28, 23, 19, 14, 12, 11, 10, 9, 2, 1, 2, 3,
                15, 69, 46, 34, 23, 17, 12, 9, 7, 6, 5, 6,
                7, 114, 108, 102, 96, 90, 87, 86, 85, 84, 83, 82,
                81, 80, 79, 78, 77, 98, 95, 91, 87, 84, 80, 77,
                75, 74, 73, 71, 70, 69, 68, 51, 20, 15, 131, 113,
                111, 108, 106, 104, 101, 100, 99, 98, 97, 96, 95, 94,
                93, 92, 91, 90, 89, 88, 131, 122, 113, 104, 99, 97,
                96, 94, 92, 90, 89, 87, 85, 83, 82, 80, 78, 77,
                75, 73, 71, 70, 68, 100, 84, 75, 71, 67, 63, 59,
                58, 56, 55, 53, 51, 50, 48, 46, 45, 43, 42, 40,
                38, 37, 35, 34, 33, 32, 31, 30, 29, 28, 27, 26,
                25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14,
                13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2,
                1, 0
            },
            -1);
    }
}
