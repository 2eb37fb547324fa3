//! Products of exponentials of two letters that do not commute, as series of words, and with them every order condition
//! of a splitting method.
//!
//! Source: Hairer, Lubich and Wanner, Geometric Numerical Integration, section III.5: a product of exp(a_i h A) and
//! exp(b_i h B) has order p if and only if its series agrees with that of exp(h(A + B)) in all words of at most p letters.
//! Check: exp(A) exp(B) has the words A…AB…B only, in `tests/exact/numerics.rs`.

/// The coefficients of all words of 0, 1, 2, … letters; the bits of a place are the letters, the last one lowest.
#[derive(Clone, Debug)]
pub struct Series(Vec<Vec<f64>>);

impl Series {
    /// 1, known to words of `most` letters.
    pub fn one(most: usize) -> Self {
        let mut words: Vec<_> = (0..=most).map(|n| vec![0.0; 1 << n]).collect();
        words[0][0] = 1.0;
        Self(words)
    }

    /// Times exp(a X) from the right, X being the letter 0 or 1.
    pub fn times(&self, letter: usize, a: f64) -> Self {
        let sum = |n: usize, word: usize| {
            let (mut sum, mut factor) = (self.0[n][word], 1.0);
            for taken in 1..=n {
                if (word >> (taken - 1)) & 1 != letter {
                    break;
                }
                factor *= a / taken as f64;
                sum += factor * self.0[n - taken][word >> taken];
            }
            sum
        };
        Self((0..self.0.len()).map(|n| (0..1 << n).map(|word| sum(n, word)).collect()).collect())
    }

    /// The largest difference from exp(A + B) in words of `n` letters, times n!.
    pub fn defect(&self, n: usize) -> f64 {
        let factorial: f64 = (1..=n).map(|i| i as f64).product();
        self.0[n].iter().map(|c| (c * factorial - 1.0).abs()).fold(0.0, f64::max)
    }

    /// The coefficient of a word, its letters as bits.
    pub fn coefficient(&self, letters: &[usize]) -> f64 {
        self.0[letters.len()][letters.iter().fold(0, |word, letter| 2 * word + letter)]
    }
}
