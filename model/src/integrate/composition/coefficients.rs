//! Coefficients of symmetric compositions: of symmetric steps of order 2, and of Nyström's kind.
//!
//! Chosen by the paper's scene. At equal work the 13 stages (order 6) and 21 (order 8) of Sofroniou and Spaletta 2005 have
//! errors smaller by a factor 1.4 to 1.7, which saves a tenth of the work; the shorter ones below need fewer kicks a step.

use super::Composition;

/// Order 2: Strang 1968.
pub static STRANG: Composition =
    Composition { order: 2, drifts: &between::<2>(&[1.0]), kicks: &mirrored::<1>(&[1.0]), stable: 2.0, nystrom: None };

/// Order 4, 5 stages: Suzuki 1990; 1/(4 − ∛4), and what is left of 1.
pub static SUZUKI: Composition = Composition {
    order: 4,
    drifts: &between::<6>(&FOURTH),
    kicks: &mirrored::<5>(&FOURTH),
    stable: 2.72,
    nystrom: None,
};

const FOURTH: [f64; 3] = [0.414_490_771_794_375_7, 0.414_490_771_794_375_7, -0.657_963_087_177_503];

/// Order 6, 11 stages: Sofroniou and Spaletta 2005.
pub static SOFRONIOU: Composition = Composition {
    order: 6,
    drifts: &between::<12>(&SIXTH),
    kicks: &mirrored::<11>(&SIXTH),
    stable: 2.95,
    nystrom: Some(&BLANES_AND_MOAN),
};

const SIXTH: [f64; 6] = [
    0.213_755_839_458_782_54,
    0.183_293_814_074_257_13,
    0.176_928_194_730_989_45,
    -0.443_290_826_811_702_2,
    0.117_285_604_328_659_35,
    0.504_054_748_438_027_3,
];

/// Order 8, 17 stages: Kahan and Li 1997 (s17odr8a); Hairer, Lubich and Wanner, Geometric Numerical Integration, V.3.2.
pub static KAHAN: Composition = Composition {
    order: 8,
    drifts: &between::<18>(&EIGHTH),
    kicks: &mirrored::<17>(&EIGHTH),
    stable: 3.09,
    nystrom: None,
};

const EIGHTH: [f64; 9] = [
    0.130_202_483_088_890_07,
    0.561_162_981_775_108_4,
    -0.389_474_962_644_847_27,
    0.158_841_906_555_155_6,
    -0.395_903_894_133_237_57,
    0.184_539_640_978_315_7,
    0.258_374_387_686_322_04,
    0.295_011_723_609_310_3,
    -0.605_508_533_830_034_6,
];

/// Order 6 where kicks depend on the place alone, 14 stages: Blanes and Moan 2002 (SRKN14a). The last of each half is what is left
/// of 1.
pub static BLANES_AND_MOAN: Composition = Composition {
    order: 6,
    drifts: &mirrored::<15>(&DRIFTS),
    kicks: &mirrored::<14>(&KICKS),
    stable: 6.15,
    nystrom: None,
};

const DRIFTS: [f64; 8] = completed([
    0.037_859_319_840_611_6,
    0.102_635_633_102_435,
    -0.025_867_888_266_558_7,
    0.314_241_403_071_447,
    -0.130_144_459_517_415,
    0.106_417_700_369_543,
    -0.008_794_243_128_510_58,
    1.0,
]);

const KICKS: [f64; 7] = completed([
    0.091_719_152_624_461_65,
    0.183_983_170_005_006,
    -0.056_534_365_832_888_27,
    0.004_914_688_774_712_854,
    0.143_761_127_168_358,
    0.328_567_693_746_804,
    0.5,
]);

/// The last becomes what it is more than all others together, each as often as it counts beside the last.
const fn completed<const N: usize>(mut half: [f64; N]) -> [f64; N] {
    let times = 2.0 * half[N - 1];
    let mut i = 0;
    while i < N - 1 {
        half[N - 1] -= times * half[i];
        i += 1;
    }
    half
}

/// The same from both ends.
const fn mirrored<const N: usize>(half: &[f64]) -> [f64; N] {
    let mut all = [0.0; N];
    let mut i = 0;
    while i < half.len() {
        (all[i], all[N - 1 - i]) = (half[i], half[i]);
        i += 1;
    }
    all
}

/// The drifts of symmetric steps of these sizes: half of each stands before its kick and half behind it.
const fn between<const N: usize>(half: &[f64]) -> [f64; N] {
    let (mut all, mut i) = ([0.0; N], 0);
    while i < N - 1 {
        let size = half[if i < half.len() { i } else { N - 2 - i }];
        all[i] += 0.5 * size;
        all[i + 1] += 0.5 * size;
        i += 1;
    }
    all
}
