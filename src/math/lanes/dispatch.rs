/// Evaluates an expression with the widest [`Lanes`](super::Lanes) that the processor has, under the name that stands before `=>`.
#[cfg(target_arch = "x86_64")]
macro_rules! with_lanes {
    ($l:ident => $body:expr) => {
        if let Some($l) = $crate::math::lanes::Avx2::try_new() {
            $body
        } else {
            let $l = $crate::math::lanes::Portable;
            $body
        }
    };
}
/// Evaluates an expression with the widest [`Lanes`] that the processor has, under the name that stands before `=>`.
#[cfg(not(target_arch = "x86_64"))]
macro_rules! with_lanes {
    ($l:ident => $body:expr) => {{
        let $l = $crate::math::lanes::Portable;
        $body
    }};
}
pub(crate) use with_lanes;

/// Compiles a function once per instruction set; calls choose among the versions at run time. A first parameter
/// `l: impl Lanes` is not an argument of the function: the body gets the widest lanes that the processor has.
macro_rules! simd_dispatch {
    ($(#[$meta:meta])* $vis:vis fn $name:ident($l:ident: impl Lanes, $($arg:tt)*) $(-> $ret:ty)? $body:block) => {
        $crate::math::lanes::simd_dispatch! {
            $(#[$meta])* $vis fn $name($($arg)*) $(-> $ret)? { $crate::math::lanes::with_lanes!($l => $body) }
        }
    };
    ($(#[$meta:meta])* $vis:vis fn $name:ident($($arg:tt)*) $(-> $ret:ty)? $body:block) => {
        $(#[$meta])*
        #[::multiversion::multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
        $vis fn $name($($arg)*) $(-> $ret)? $body
    };
}
pub(crate) use simd_dispatch;
