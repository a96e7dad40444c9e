import android.os.Build;
import android.os.VibrationEffect;
import android.os.Vibrator;

public final class VibrationOfClickClock {
    private VibrationOfClickClock() {}

    public static VibrationEffect vibrationOfClickClock(Vibrator vibrator) {
        if (Build.VERSION.SDK_INT >= 36 && vibrator.areEnvelopeEffectsSupported()) {
            return new VibrationEffect.WaveformEnvelopeBuilder()
            .setInitialFrequencyHz(209.14f)
            .addControlPoint(0f, 209.14f, 15)
            .addControlPoint(0.0071f, 209.14f, 5)
            .addControlPoint(0.0106f, 209.14f, 5)
            .addControlPoint(0.0309f, 209.14f, 5)
            .addControlPoint(0.1346f, 209.14f, 5)
            .addControlPoint(0.3431f, 209.14f, 5)
            .addControlPoint(0.7654f, 209.14f, 15)
            .addControlPoint(0.3431f, 209.14f, 25)
            .addControlPoint(0.1759f, 209.14f, 35)
            .addControlPoint(0.1178f, 209.14f, 35)
            .addControlPoint(0.0789f, 209.14f, 35)
            .addControlPoint(0.0901f, 209.14f, 15)
            .addControlPoint(0.069f, 209.14f, 10)
            .addControlPoint(0.0462f, 209.14f, 45)
            .addControlPoint(0.0462f, 209.14f, 25)
            .addControlPoint(0.0353f, 209.14f, 20)
            .addControlPoint(0.0353f, 209.14f, 60)
            .addControlPoint(0.0287f, 209.14f, 20)
            .addControlPoint(0.0271f, 209.14f, 5)
            .addControlPoint(0.0353f, 209.14f, 15)
            .addControlPoint(0.0528f, 209.14f, 5)
            .addControlPoint(0.1759f, 209.14f, 5)
            .addControlPoint(0.8749f, 209.14f, 20)
            .addControlPoint(0.3922f, 209.14f, 25)
            .addControlPoint(0.3002f, 209.14f, 10)
            .addControlPoint(0.201f, 209.14f, 20)
            .addControlPoint(0.1678f, 209.14f, 15)
            .addControlPoint(0.1346f, 209.14f, 15)
            .addControlPoint(0.069f, 209.14f, 60)
            .addControlPoint(0.0664f, 209.14f, 5)
            .addControlPoint(0.0462f, 209.14f, 40)
            .addControlPoint(0.0462f, 209.14f, 25)
            .addControlPoint(0.0528f, 209.14f, 5)
            .addControlPoint(0.0462f, 209.14f, 10)
            .addControlPoint(0.0353f, 209.14f, 25)
            .addControlPoint(0.0353f, 209.14f, 35)
            .addControlPoint(0.0271f, 209.14f, 20)
            .addControlPoint(0.0271f, 209.14f, 35)
            .addControlPoint(0.0462f, 209.14f, 5)
            .addControlPoint(0.1538f, 209.14f, 5)
            .addControlPoint(0.3431f, 209.14f, 5)
            .addControlPoint(0.6246f, 209.14f, 10)
            .addControlPoint(0.7654f, 209.14f, 5)
            .addControlPoint(0.5125f, 209.14f, 10)
            .addControlPoint(0.3002f, 209.14f, 15)
            .addControlPoint(0.2505f, 209.14f, 10)
            .addControlPoint(0.1759f, 209.14f, 15)
            .addControlPoint(0.1178f, 209.14f, 25)
            .addControlPoint(0.0789f, 209.14f, 50)
            .addControlPoint(0.0462f, 209.14f, 60)
            .addControlPoint(0.0435f, 209.14f, 10)
            .addControlPoint(0.0353f, 209.14f, 30)
            .addControlPoint(0.0404f, 209.14f, 25)
            .addControlPoint(0.0309f, 209.14f, 20)
            .addControlPoint(0.0237f, 209.14f, 60)
            .addControlPoint(0.0271f, 209.14f, 15)
            .addControlPoint(0.0462f, 209.14f, 5)
            .addControlPoint(0.5125f, 209.14f, 15)
            .addControlPoint(0.6811f, 209.14f, 10)
            .addControlPoint(0.7654f, 209.14f, 5)
            .addControlPoint(0.3922f, 209.14f, 20)
            .addControlPoint(0.3002f, 209.14f, 10)
            .addControlPoint(0.201f, 209.14f, 20)
            .addControlPoint(0.1346f, 209.14f, 30)
            .addControlPoint(0.0901f, 209.14f, 30)
            .addControlPoint(0.0462f, 209.14f, 75)
            .addControlPoint(0.045f, 209.14f, 10)
            .addControlPoint(0.0353f, 209.14f, 80)
            .addControlPoint(0.0404f, 209.14f, 5)
            .addControlPoint(0.0309f, 209.14f, 20)
            .addControlPoint(0.0271f, 209.14f, 40)
            .addControlPoint(0.0353f, 209.14f, 5)
            .addControlPoint(0.1178f, 209.14f, 5)
            .addControlPoint(0.2797f, 209.14f, 5)
            .addControlPoint(0.7654f, 209.14f, 15)
            .addControlPoint(0.3922f, 209.14f, 30)
            .addControlPoint(0.201f, 209.14f, 40)
            .addControlPoint(0.1346f, 209.14f, 30)
            .addControlPoint(0.1282f, 209.14f, 5)
            .addControlPoint(0.0901f, 209.14f, 30)
            .addControlPoint(0.0528f, 209.14f, 55)
            .addControlPoint(0.0353f, 209.14f, 50)
            .addControlPoint(0.0404f, 209.14f, 10)
            .addControlPoint(0.0309f, 209.14f, 30)
            .addControlPoint(0.0309f, 209.14f, 60)
            .addControlPoint(0.0331f, 209.14f, 5)
            .addControlPoint(0.0353f, 209.14f, 5)
            .addControlPoint(0.0789f, 209.14f, 5)
            .addControlPoint(0.1759f, 209.14f, 5)
            .addControlPoint(0.3922f, 209.14f, 5)
            .addControlPoint(0.6696f, 209.14f, 15)
            .addControlPoint(0.5773f, 209.14f, 5)
            .addControlPoint(0.3002f, 209.14f, 15)
            .addControlPoint(0.1759f, 209.14f, 20)
            .addControlPoint(0.1178f, 209.14f, 30)
            .addControlPoint(0.0789f, 209.14f, 35)
            .addControlPoint(0.0447f, 209.14f, 80)
            .addControlPoint(0.0404f, 209.14f, 10)
            .addControlPoint(0.0404f, 209.14f, 10)
            .addControlPoint(0.0271f, 209.14f, 130)
            .addControlPoint(0.0309f, 209.14f, 5)
            .addControlPoint(0.0353f, 209.14f, 5)
            .addControlPoint(0.103f, 209.14f, 5)
            .addControlPoint(0.7654f, 209.14f, 20)
            .addControlPoint(0.5125f, 209.14f, 10)
            .addControlPoint(0.3922f, 209.14f, 15)
            .addControlPoint(0.201f, 209.14f, 40)
            .addControlPoint(0.1346f, 209.14f, 30)
            .addControlPoint(0.0901f, 209.14f, 25)
            .addControlPoint(0.0528f, 209.14f, 65)
            .addControlPoint(0.0353f, 209.14f, 55)
            .addControlPoint(0.0353f, 209.14f, 40)
            .addControlPoint(0.0271f, 209.14f, 45)
            .addControlPoint(0.0309f, 209.14f, 25)
            .addControlPoint(0.0528f, 209.14f, 5)
            .addControlPoint(0.1538f, 209.14f, 5)
            .addControlPoint(0.3002f, 209.14f, 5)
            .addControlPoint(0.5465f, 209.14f, 10)
            .addControlPoint(0.6696f, 209.14f, 5)
            .addControlPoint(0.3431f, 209.14f, 20)
            .addControlPoint(0.2298f, 209.14f, 15)
            .addControlPoint(0.1346f, 209.14f, 25)
            .addControlPoint(0.0789f, 209.14f, 40)
            .addControlPoint(0.0738f, 209.14f, 15)
            .addControlPoint(0.0604f, 209.14f, 40)
            .addControlPoint(0.069f, 209.14f, 15)
            .addControlPoint(0.0462f, 209.14f, 25)
            .addControlPoint(0.0462f, 209.14f, 15)
            .addControlPoint(0.0309f, 209.14f, 35)
            .addControlPoint(0.0404f, 209.14f, 25)
            .addControlPoint(0.0249f, 209.14f, 65)
            .addControlPoint(0.0237f, 209.14f, 5)
            .addControlPoint(0.0404f, 209.14f, 5)
            .addControlPoint(0.1178f, 209.14f, 5)
            .addControlPoint(0.7654f, 209.14f, 20)
            .addControlPoint(0.3431f, 209.14f, 25)
            .addControlPoint(0.2298f, 209.14f, 15)
            .addControlPoint(0.1538f, 209.14f, 20)
            .addControlPoint(0.0901f, 209.14f, 40)
            .addControlPoint(0.0736f, 209.14f, 25)
            .addControlPoint(0.0604f, 209.14f, 20)
            .addControlPoint(0.0271f, 209.14f, 105)
            .addControlPoint(0.0353f, 209.14f, 60)
            .addControlPoint(0.0271f, 209.14f, 25)
            .addControlPoint(0.0309f, 209.14f, 10)
            .addControlPoint(0.0404f, 209.14f, 5)
            .addControlPoint(0.0901f, 209.14f, 5)
            .addControlPoint(0.1759f, 209.14f, 5)
            .addControlPoint(0.7654f, 209.14f, 20)
            .addControlPoint(0.6861f, 209.14f, 5)
            .addControlPoint(0.4483f, 209.14f, 15)
            .addControlPoint(0.3002f, 209.14f, 15)
            .addControlPoint(0.1759f, 209.14f, 25)
            .addControlPoint(0.1346f, 209.14f, 20)
            .addControlPoint(0.1282f, 209.14f, 5)
            .addControlPoint(0.1028f, 209.14f, 20)
            .addControlPoint(0.0901f, 209.14f, 10)
            .addControlPoint(0.0723f, 209.14f, 30)
            .addControlPoint(0.0604f, 209.14f, 20)
            .addControlPoint(0.0309f, 209.14f, 80)
            .addControlPoint(0.0271f, 209.14f, 95)
            .addControlPoint(0.0353f, 209.14f, 5)
            .addControlPoint(0.0789f, 209.14f, 5)
            .addControlPoint(0.7654f, 209.14f, 20)
            .addControlPoint(0.3431f, 209.14f, 30)
            .addControlPoint(0.1759f, 209.14f, 25)
            .addControlPoint(0.103f, 209.14f, 40)
            .addControlPoint(0f, 209.14f, 1)
            .build();
        }
        return VibrationEffect.createWaveform(
            new long[] {
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 30, 10, 10, 70, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 40, 10, 10, 10, 40, 10, 50,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 20, 10, 20,
                20, 10, 20, 30, 20, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 30, 30, 20, 10, 10, 20, 30,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 20, 10, 10,
                10, 10, 10, 20, 70, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 40, 40, 40, 20, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 20, 10, 60, 20,
                30, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 20, 10, 20, 10, 10, 10, 20, 10,
                10, 20, 10, 20, 10, 20, 20, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 20, 10, 10, 10, 20, 10, 20, 30, 20,
                10, 20, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 50, 60, 10, 10, 10, 10, 10,
                10, 10, 10, 10, 10, 10, 10
            },
            new int[] {
                0, 1, 3, 34, 123, 195, 152, 109, 81, 69, 57, 45,
                41, 36, 32, 29, 26, 23, 20, 22, 20, 17, 16, 14,
                13, 12, 11, 10, 9, 8, 7, 8, 13, 89, 179, 198,
                149, 100, 77, 64, 51, 46, 40, 34, 32, 29, 26, 23,
                20, 18, 16, 15, 14, 12, 13, 11, 10, 9, 8, 7,
                39, 123, 195, 131, 95, 70, 58, 45, 39, 33, 29, 27,
                25, 23, 21, 19, 18, 17, 15, 14, 12, 11, 10, 9,
                10, 9, 8, 7, 6, 7, 12, 91, 152, 195, 148, 100,
                77, 64, 51, 46, 40, 34, 31, 27, 23, 21, 20, 18,
                17, 16, 14, 13, 12, 11, 10, 9, 10, 9, 8, 7,
                30, 113, 195, 163, 132, 100, 88, 76, 63, 51, 46, 40,
                34, 31, 28, 25, 22, 20, 19, 17, 15, 13, 12, 11,
                10, 9, 10, 9, 8, 9, 45, 124, 171, 124, 77, 61,
                45, 40, 35, 30, 27, 24, 22, 20, 18, 17, 16, 15,
                14, 13, 12, 11, 10, 9, 8, 7, 8, 26, 111, 195,
                131, 110, 94, 82, 70, 57, 48, 43, 37, 32, 28, 23,
                22, 20, 19, 17, 16, 14, 13, 12, 11, 10, 9, 8,
                7, 8, 39, 108, 171, 129, 87, 68, 54, 44, 34, 31,
                27, 24, 20, 19, 18, 17, 16, 18, 15, 13, 12, 11,
                10, 8, 9, 10, 9, 8, 7, 6, 30, 113, 195, 152,
                109, 78, 59, 49, 39, 35, 31, 27, 23, 21, 20, 18,
                16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 8, 9,
                8, 7, 10, 45, 120, 195, 155, 114, 89, 70, 58, 45,
                40, 34, 31, 28, 25, 22, 21, 19, 18, 16, 15, 14,
                13, 12, 11, 10, 9, 8, 7, 20, 108, 195, 159, 123,
                87, 70, 53, 43, 38, 33, 29
            },
            -1);
    }
}
