import android.os.Build;
import android.os.VibrationEffect;
import android.os.Vibrator;

public final class VibrationOfSweepSpringUp {
    private VibrationOfSweepSpringUp() {}

    public static VibrationEffect vibrationOfSweepSpringUp(Vibrator vibrator) {
        if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
            return new VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(35.404f)
            .addControlPoint(0.1346f, 35.404f, 1)
            .addControlPoint(0.1909f, 35.404f, 10)
            .addControlPoint(0.522f, 100f, 10)
            .addControlPoint(0.4134f, 35.404f, 10)
            .addControlPoint(0.6397f, 35.404f, 9)
            .addControlPoint(0.7654f, 61.287f, 5)
            .addControlPoint(0.7654f, 61.287f, 15)
            .addControlPoint(0.7654f, 61.287f, 20)
            .addControlPoint(0.7654f, 81.808f, 20)
            .addControlPoint(0.7654f, 112.4f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 271.22f, 20)
            .addControlPoint(0.7654f, 271.22f, 20)
            .addControlPoint(0.7654f, 351.73f, 20)
            .addControlPoint(0.7654f, 351.73f, 20)
            .addControlPoint(0.7654f, 351.73f, 20)
            .addControlPoint(0.7654f, 351.73f, 20)
            .addControlPoint(0.7654f, 351.73f, 20)
            .addControlPoint(0.7654f, 351.73f, 20)
            .addControlPoint(0.7654f, 512f, 20)
            .addControlPoint(0.7654f, 512f, 20)
            .addControlPoint(0.7654f, 512f, 40)
            .addControlPoint(0.7654f, 512f, 20)
            .addControlPoint(0.7654f, 512f, 20)
            .addControlPoint(0.7654f, 512f, 20)
            .addControlPoint(0.7654f, 645.08f, 20)
            .addControlPoint(0.7654f, 645.08f, 20)
            .addControlPoint(0.7654f, 645.08f, 20)
            .addControlPoint(0.7654f, 645.08f, 20)
            .addControlPoint(0.7654f, 645.08f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 20)
            .addControlPoint(0.7654f, 189.03f, 15)
            .addControlPoint(0.5858f, 189.03f, 5)
            .addControlPoint(0.1759f, 189.03f, 5)
            .addControlPoint(0.201f, 189.03f, 5)
            .addControlPoint(0.4832f, 189.03f, 10)
            .addControlPoint(0.7654f, 189.03f, 10)
            .addControlPoint(0.7355f, 189.03f, 10)
            .addControlPoint(0.6157f, 189.03f, 40)
            .addControlPoint(0.5858f, 189.03f, 10)
            .addControlPoint(0.3698f, 189.03f, 10)
            .addControlPoint(0.1538f, 189.03f, 10)
            .addControlPoint(0.1178f, 189.03f, 5)
            .addControlPoint(0.2298f, 189.03f, 5)
            .addControlPoint(0.4483f, 189.03f, 5)
            .addControlPoint(0.4166f, 189.03f, 15)
            .addControlPoint(0.3742f, 189.03f, 20)
            .addControlPoint(0.3002f, 189.03f, 35)
            .addControlPoint(0.2946f, 189.03f, 5)
            .addControlPoint(0.272f, 189.03f, 20)
            .addControlPoint(0.2494f, 189.03f, 20)
            .addControlPoint(0.2268f, 189.03f, 20)
            .addControlPoint(0.2041f, 189.03f, 20)
            .addControlPoint(0.1815f, 189.03f, 20)
            .addControlPoint(0.1759f, 189.03f, 5)
            .addControlPoint(0.1537f, 189.03f, 35)
            .addControlPoint(0.141f, 189.03f, 20)
            .addControlPoint(0.1282f, 189.03f, 20)
            .addControlPoint(0.1028f, 189.03f, 40)
            .addControlPoint(0.0901f, 189.03f, 20)
            .addControlPoint(0.0776f, 189.03f, 40)
            .addControlPoint(0.0713f, 189.03f, 20)
            .addControlPoint(0.065f, 189.03f, 20)
            .addControlPoint(0.0587f, 189.03f, 20)
            .addControlPoint(0.0462f, 189.03f, 40)
            .addControlPoint(0.0407f, 189.03f, 40)
            .addControlPoint(0.038f, 189.03f, 20)
            .addControlPoint(0.0353f, 189.03f, 20)
            .addControlPoint(0.0271f, 189.03f, 60)
            .addControlPoint(0.0249f, 189.03f, 20)
            .addControlPoint(0.0228f, 189.03f, 20)
            .addControlPoint(0.0185f, 189.03f, 40)
            .addControlPoint(0.0121f, 189.03f, 60)
            .addControlPoint(0.0096f, 189.03f, 60)
            .addControlPoint(0.0062f, 189.03f, 80)
            .addControlPoint(0.0042f, 189.03f, 55)
            .addControlPoint(0f, 189.03f, 10)
            .addControlPoint(0f, 189.03f, 15)
            .addControlPoint(0f, 189.03f, 15)
            .addControlPoint(0f, 189.03f, 4)
            .build();
        }
        return VibrationEffect.createWaveform(
            new long[] {
                11, 20, 19, 670, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 20, 10, 10, 10, 20, 10, 10, 20,
                30, 30, 20, 30, 30, 40, 40, 40, 70, 90, 50, 39
            },
            new int[] {
                42, 133, 166, 195, 45, 87, 159, 191, 184, 176, 168, 161,
                153, 122, 67, 30, 114, 109, 104, 98, 93, 87, 82, 77,
                74, 71, 68, 65, 62, 59, 56, 53, 51, 48, 45, 43,
                42, 40, 38, 37, 35, 34, 32, 30, 29, 27, 25, 24,
                23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12,
                11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0
            },
            -1);
    }
}
