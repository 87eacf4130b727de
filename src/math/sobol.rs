//! Owen-scrambled Sobol points as pure functions of (seed, stream, index, dimension) \[Burley20\].
//!
//! Dimensions come in sets of four (padding). Within a set, every aligned power-of-two block of indices is a digital net; sets
//! are combined at random, by shuffled indices. A path should therefore use its first four numbers for its most
//! important choices.

use glam::DVec2;

/// The purpose of a stream of random numbers. Streams are independent of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Paths from the camera, one sequence per pixel.
    Camera,
    /// Photons aimed at specular surfaces.
    CausticPhoton,
    /// Photons of interreflection.
    GlobalPhoton,
    /// Paths that probe which surfaces a light reaches.
    Probe,
    /// The choice of the sample that gathers photons, one sequence per pixel, one index per iteration.
    GatheringSample,
    /// Direction of a visibility polygon's first corner, one sequence per pixel, one index per iteration.
    VisibilityPolygon,
    /// Where a light's lattice of sheets lies, and the point of the lamp from which it begins; one sequence per light, one index per
    /// iteration.
    LightSheets,
    /// Rays that tell which parts of a pixel show a surface, one sequence per pixel, one index per iteration.
    VisibleParts,
    /// The stream with this number in draft frames, whose numbers are independent of the converging picture.
    Draft(u8),
}

impl Stream {
    /// The number of the stream, different for every stream.
    pub const fn number(self) -> u8 {
        match self {
            Self::Camera => 1,
            Self::CausticPhoton => 2,
            Self::GlobalPhoton => 3,
            Self::Probe => 4,
            Self::GatheringSample => 6,
            Self::VisibilityPolygon => 7,
            Self::LightSheets => 8,
            Self::VisibleParts => 9,
            Self::Draft(number) => 0x80 | number,
        }
    }
}

/// A point of a sequence; returns its coordinates one after another.
#[derive(Clone, Debug)]
pub struct Sampler {
    index: u32,
    seed: u32,
    set: u32,
    used: usize,
    /// The coordinates of the set, with their bits reversed.
    point: [u32; 4],
}

impl Sampler {
    /// The point `index` of the sequence (seed, stream, sequence). Indices from `2^32` on start a new, independently scrambled
    /// sequence.
    pub fn new(seed: u64, stream: Stream, sequence: u64, index: u64) -> Self {
        let key = mix64(seed ^ mix64(sequence ^ mix64((index >> 32) ^ (u64::from(stream.number()) << 56))));
        let mut sampler =
            Self { index: index as u32, seed: key as u32 ^ (key >> 32) as u32, set: 0, used: 0, point: [0; 4] };
        sampler.load_set();
        sampler
    }

    /// The next coordinate, above 0 and below 1.
    pub fn next_1d(&mut self) -> f64 {
        if self.used == 4 {
            self.next_set();
        }
        let x = self.point[self.used];
        self.used += 1;
        unit_from_bits(x.reverse_bits())
    }

    /// The next two coordinates, both from one set of four, so that they are stratified together.
    pub fn next_2d(&mut self) -> DVec2 {
        if self.used > 2 {
            self.next_set();
        }
        DVec2::new(self.next_1d(), self.next_1d())
    }

    /// Skips the unused coordinates of this set of four.
    pub fn next_set(&mut self) {
        self.set += 1;
        self.used = 0;
        self.load_set();
    }

    fn load_set(&mut self) {
        let set_seed = hash32(self.seed ^ hash32(self.set));
        let shuffled = owen_scramble(self.index.reverse_bits(), set_seed);
        for (dimension, x) in self.point.iter_mut().enumerate() {
            let key = hash32(set_seed ^ (dimension as u32 + 1).wrapping_mul(0x9e37_79b9));
            *x = owen_scramble(sobol_bits(shuffled, dimension), key);
        }
    }
}

/// A 64-bit hash: the finalizer of SplitMix64.
pub fn mix64(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

fn hash32(x: u32) -> u32 {
    let x = (x ^ (x >> 16)).wrapping_mul(0x21f0_aaad);
    let x = (x ^ (x >> 15)).wrapping_mul(0x735a_2d97);
    x ^ (x >> 15)
}

/// The center of the interval of length `2^-32` with these first bits: above 0 and below 1.
fn unit_from_bits(bits: u32) -> f64 {
    (f64::from(bits) + 0.5) * 2f64.powi(-32)
}

/// Owen's nested uniform scrambling of a number with reversed bits, by a hash whose low bits affect only higher bits
/// \[LaineKarras11\].
fn owen_scramble(x: u32, seed: u32) -> u32 {
    let mut x = x;
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x
}

/// Coordinate `dimension` (0 to 3) of a Sobol point as a binary fraction of 32 bits; it and the index have reversed bits.
fn sobol_bits(reversed_index: u32, dimension: usize) -> u32 {
    let table = &SOBOL_BYTES[dimension];
    let [a, b, c, d] = reversed_index.to_le_bytes();
    table[0][a as usize] ^ table[1][b as usize] ^ table[2][c as usize] ^ table[3][d as usize]
}

/// For each dimension and each byte of the index, the XOR of the direction numbers of the set bits, bits reversed.
static SOBOL_BYTES: [[[u32; 256]; 4]; 4] = sobol_bytes();

const fn sobol_bytes() -> [[[u32; 256]; 4]; 4] {
    let directions = [
        direction_numbers(0, 0, [1, 0, 0]),
        direction_numbers(1, 0, [1, 0, 0]),
        direction_numbers(2, 1, [1, 3, 0]),
        direction_numbers(3, 1, [1, 3, 1]),
    ];
    let mut tables = [[[0u32; 256]; 4]; 4];
    let mut k = 0;
    while k < 4 * 4 * 256 {
        let (dimension, byte, value) = (k / 1024, (k / 256) % 4, k % 256);
        let mut bit = 0;
        while bit < 8 {
            if value >> bit & 1 == 1 {
                tables[dimension][byte][value] ^= directions[dimension][31 - (8 * byte + bit)].reverse_bits();
            }
            bit += 1;
        }
        k += 1;
    }
    tables
}

/// The direction numbers of a primitive polynomial of this degree and of the first odd integers \[JoeKuo08\].
const fn direction_numbers(degree: usize, coefficients: u32, first: [u32; 3]) -> [u32; 32] {
    let mut v = [0u32; 32];
    let mut i = 0;
    while i < 32 {
        v[i] = if degree == 0 {
            1 << (31 - i)
        } else if i < degree {
            first[i] << (31 - i)
        } else {
            let mut x = v[i - degree] ^ (v[i - degree] >> degree);
            let mut k = 1;
            while k < degree {
                if coefficients >> (degree - 1 - k) & 1 == 1 {
                    x ^= v[i - k];
                }
                k += 1;
            }
            x
        };
        i += 1;
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every aligned block of 256 points hits each of the 16 x 16 cells once, in any two dimensions of set 0's pairs
    /// that form a (0, 2)-sequence, and each of 256 intervals once in every single dimension.
    #[test]
    fn aligned_blocks_are_nets() {
        for block in [0u64, 5, 1 << 20] {
            let mut cells = [false; 256];
            let mut intervals = [[false; 256]; 4];
            for k in 0..256 {
                let mut sampler = Sampler::new(7, Stream::Camera, 3, block * 256 + k);
                let x: Vec<f64> = (0..4).map(|_| sampler.next_1d()).collect();
                for (hit, x) in intervals.iter_mut().zip(&x) {
                    assert!(!std::mem::replace(&mut hit[(x * 256.0) as usize], true), "an interval is hit once");
                }
                let cell = (x[0] * 16.0) as usize * 16 + (x[1] * 16.0) as usize;
                assert!(!std::mem::replace(&mut cells[cell], true), "a cell is hit once");
            }
        }
    }

    #[test]
    fn sequences_and_sets_are_independent() {
        let pairs = 4096;
        let mut covariance = [0.0; 3];
        for k in 0..pairs {
            let mut a = Sampler::new(1, Stream::Camera, 0, k);
            let mut b = Sampler::new(1, Stream::Camera, 1, k);
            let mut c = Sampler::new(1, Stream::Camera, 0, k + (1 << 32));
            let first = a.next_1d() - 0.5;
            covariance[0] += first * (b.next_1d() - 0.5);
            covariance[1] += first * (c.next_1d() - 0.5);
            a.next_set();
            covariance[2] += first * (a.next_1d() - 0.5);
        }
        for c in covariance {
            // Independent uniforms have a covariance of standard error 1 / (12 sqrt(n)) = 1.3e-3; five of these.
            assert!((c / pairs as f64).abs() < 6.5e-3, "covariance {covariance:?}");
        }
    }
}
