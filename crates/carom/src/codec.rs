//! Values as bytes, for snapshots: little-endian, whole numbers in as few bytes as they need, floating-point numbers bit by
//! bit. A struct lists its fields once, with [`codec!`]: a field that is missing in the list does not compile.
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;

use crate::Vector;

/// The hash (64-bit FNV-1a) that seals bytes and names layouts.
#[derive(Clone, Copy, Debug)]
pub struct Hash(pub u64);

impl Hash {
    pub const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub fn add(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

/// Bytes to be read from the front.
#[derive(Clone, Debug)]
pub struct Reader<'a> {
    rest: &'a [u8],
    /// How many elements may still be made by repeating one: so that a few bytes which lie do not fill the memory.
    repeats: usize,
}

/// No world repeats more elements than this for each byte: every body has a position of its own, of at least eight bytes,
/// and a few dozen values that may be those of all others.
const REPEATS_PER_BYTE: usize = 8;

impl<'a> Reader<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, repeats: bytes.len().saturating_mul(REPEATS_PER_BYTE) }
    }

    pub fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    /// Takes `n` bytes.
    fn take(&mut self, n: usize) -> Option<&'a [u8]> {
        let (first, rest) = self.rest.split_at_checked(n)?;
        self.rest = rest;
        Some(first)
    }
}

/// What has a form as bytes. (Public only for the bound of [`crate::Rotates::Spin`]; nobody outside can name it.)
pub trait Codec: Sized {
    /// Names the layout: another list of fields, or another order of them, is another layout.
    fn layout(hash: &mut Hash);
    fn write(&self, to: &mut Vec<u8>);
    /// Takes a value from the front; `None` if there is none.
    fn read(from: &mut Reader<'_>) -> Option<Self>;
}

/// Implements [`Codec`] for a struct by its fields. What stands under `anew` is not written, and read as the value behind the
/// colon has it.
macro_rules! codec {
    (@layout $hash:ident $name:ident { $($field:ident),* }) => {{
        $hash.add(stringify!($name).as_bytes());
        $(
            $hash.add(concat!(".", stringify!($field)).as_bytes());
            $crate::codec::layout_of(|s: &Self| &s.$field, $hash);
        )*
    }};
    (@body $name:ident { $($field:ident),* $(,)? }) => {
        fn layout(hash: &mut $crate::codec::Hash) {
            $crate::codec::codec!(@layout hash $name { $($field),* });
        }
        fn write(&self, to: &mut alloc::vec::Vec<u8>) {
            let Self { $($field),* } = self;
            $($crate::codec::Codec::write($field, to);)*
        }
        fn read(from: &mut $crate::codec::Reader<'_>) -> Option<Self> {
            Some(Self { $($field: $crate::codec::Codec::read(from)?),* })
        }
    };
    // An enum without data, by the list of its values.
    (enum $name:ident: $all:expr) => {
        impl $crate::codec::Codec for $name {
            fn layout(hash: &mut $crate::codec::Hash) {
                hash.add(stringify!($name).as_bytes());
                hash.add(&[$all.len() as u8]);
            }
            fn write(&self, to: &mut alloc::vec::Vec<u8>) {
                $crate::codec::Codec::write(&$all.iter().position(|x| x == self).unwrap_or(usize::MAX), to);
            }
            fn read(from: &mut $crate::codec::Reader<'_>) -> Option<Self> {
                $all.get(<usize as $crate::codec::Codec>::read(from)?).copied()
            }
        }
    };
    ($name:ident { $($fields:tt)* }) => {
        impl $crate::codec::Codec for $name {
            $crate::codec::codec!(@body $name { $($fields)* });
        }
    };
    ($name:ident<D> { $($fields:tt)* }) => {
        impl<const D: usize> $crate::codec::Codec for $name<D>
        where
            $crate::Vector<D>: $crate::Rotates,
        {
            $crate::codec::codec!(@body $name { $($fields)* });
        }
    };
    ($name:ident<D> { $($field:ident),* $(,)? } anew { $($anew:ident),* $(,)? }: $base:expr) => {
        impl<const D: usize> $crate::codec::Codec for $name<D>
        where
            $crate::Vector<D>: $crate::Rotates,
        {
            fn layout(hash: &mut $crate::codec::Hash) {
                $crate::codec::codec!(@layout hash $name { $($field),* });
            }
            fn write(&self, to: &mut alloc::vec::Vec<u8>) {
                let Self { $($field,)* $($anew: _,)* } = self;
                $($crate::codec::Codec::write($field, to);)*
            }
            fn read(from: &mut $crate::codec::Reader<'_>) -> Option<Self> {
                $(let $field = $crate::codec::Codec::read(from)?;)*
                Some(Self { $($field,)* ..$base })
            }
        }
    };
}
pub(crate) use codec;

/// The layout of a field, whose type the compiler finds.
pub(crate) fn layout_of<S, T: Codec>(_: impl Fn(&S) -> &T, hash: &mut Hash) {
    T::layout(hash);
}

/// Seven bits a byte, the lowest first.
fn write_whole(mut x: u64, to: &mut Vec<u8>) {
    while x >= 0x80 {
        to.push(x as u8 | 0x80);
        x >>= 7;
    }
    to.push(x as u8);
}

fn read_whole(from: &mut Reader<'_>) -> Option<u64> {
    let mut x = 0u64;
    for shift in (0..64).step_by(7) {
        let byte = from.take(1)?[0];
        let part = u64::from(byte & 0x7f);
        if shift == 63 && part > 1 {
            return None;
        }
        x |= part << shift;
        if byte & 0x80 == 0 {
            return Some(x);
        }
    }
    None
}

macro_rules! whole {
    ($($type:ty),*) => {$(
        impl Codec for $type {
            fn layout(hash: &mut Hash) {
                hash.add(stringify!($type).as_bytes());
            }
            fn write(&self, to: &mut Vec<u8>) {
                write_whole(*self as u64, to);
            }
            fn read(from: &mut Reader<'_>) -> Option<Self> {
                Self::try_from(read_whole(from)?).ok()
            }
        }
    )*};
}
whole!(u8, u32, u64, usize);

impl Codec for i32 {
    fn layout(hash: &mut Hash) {
        hash.add(b"i32");
    }
    fn write(&self, to: &mut Vec<u8>) {
        // Small numbers of either sign are small: 0, -1, 1, -2, ...
        write_whole(u64::from(((*self << 1) ^ (*self >> 31)) as u32), to);
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let x = u32::try_from(read_whole(from)?).ok()?;
        Some((x >> 1) as i32 ^ -((x & 1) as i32))
    }
}

impl Codec for bool {
    fn layout(hash: &mut Hash) {
        hash.add(b"bool");
    }
    fn write(&self, to: &mut Vec<u8>) {
        to.push(u8::from(*self));
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        match from.take(1)?[0] {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl Codec for f64 {
    fn layout(hash: &mut Hash) {
        hash.add(b"f64");
    }
    fn write(&self, to: &mut Vec<u8>) {
        to.extend_from_slice(&self.to_bits().to_le_bytes());
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let bytes = from.take(8)?.try_into().ok()?;
        Some(f64::from_bits(u64::from_le_bytes(bytes)))
    }
}

impl<const N: usize> Codec for Vector<N> {
    fn layout(hash: &mut Hash) {
        <[f64; N]>::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.0.write(to);
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Some(Self(Codec::read(from)?))
    }
}

impl<T: Codec, const N: usize> Codec for [T; N] {
    fn layout(hash: &mut Hash) {
        hash.add(&[b'[', N as u8]);
        T::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|x| x.write(to));
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let mut all = Vec::with_capacity(N);
        for _ in 0..N {
            all.push(T::read(from)?);
        }
        all.try_into().ok()
    }
}

impl<T: Codec> Codec for Option<T> {
    fn layout(hash: &mut Hash) {
        hash.add(b"?");
        T::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.is_some().write(to);
        if let Some(x) = self {
            x.write(to);
        }
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        Some(if bool::read(from)? { Some(T::read(from)?) } else { None })
    }
}

/// The number of elements, whether they are all the same, and they, or it.
impl<T: Codec> Codec for Vec<T> {
    fn layout(hash: &mut Hash) {
        hash.add(b"*");
        T::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        let flag = to.len();
        to.push(0);
        let first = to.len();
        let mut one = 0;
        let mut same = self.len() > 1;
        for (k, x) in self.iter().enumerate() {
            let at = to.len();
            x.write(to);
            if k == 0 {
                one = to.len() - at;
            } else {
                same = same && to.len() - at == one && to[first..first + one] == to[at..];
            }
        }
        if same {
            to.truncate(first + one);
            to[flag] = 1;
        }
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let n = usize::read(from)?;
        let same = bool::read(from)?;
        if n == 0 {
            return Some(Self::new());
        }
        if same {
            from.repeats = from.repeats.checked_sub(n)?;
            let bytes = from.rest;
            // Read as often as there are elements: not everything here can be cloned, and few values are as cheap as bytes.
            let mut all = Self::new();
            all.try_reserve(n).ok()?;
            for _ in 0..n {
                from.rest = bytes;
                all.push(T::read(from)?);
            }
            return Some(all);
        }
        // Whatever the number says, there cannot be more elements than bytes.
        let mut all = Self::new();
        for _ in 0..n {
            if from.is_empty() {
                return None;
            }
            all.push(T::read(from)?);
        }
        Some(all)
    }
}

macro_rules! tuples {
    ($(($($type:ident $k:tt),*))*) => {$(
        impl<$($type: Codec),*> Codec for ($($type,)*) {
            fn layout(hash: &mut Hash) {
                hash.add(b"(");
                $($type::layout(hash);)*
            }
            fn write(&self, to: &mut Vec<u8>) {
                $(self.$k.write(to);)*
            }
            fn read(from: &mut Reader<'_>) -> Option<Self> {
                Some(($($type::read(from)?,)*))
            }
        }
    )*};
}
tuples! { (A 0, B 1) (A 0, B 1, C 2) }

impl<K: Codec + Ord, V: Codec> Codec for BTreeMap<K, V> {
    fn layout(hash: &mut Hash) {
        hash.add(b"map");
        K::layout(hash);
        V::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        for (key, value) in self {
            key.write(to);
            value.write(to);
        }
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let mut all = Self::new();
        for _ in 0..usize::read(from)? {
            if from.is_empty() {
                return None;
            }
            all.insert(K::read(from)?, V::read(from)?);
        }
        Some(all)
    }
}

impl<K: Codec + Ord> Codec for BTreeSet<K> {
    fn layout(hash: &mut Hash) {
        hash.add(b"set");
        K::layout(hash);
    }
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        self.iter().for_each(|key| key.write(to));
    }
    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let mut all = Self::new();
        for _ in 0..usize::read(from)? {
            if from.is_empty() {
                return None;
            }
            all.insert(K::read(from)?);
        }
        Some(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    fn there_and_back<T: Codec + PartialEq + core::fmt::Debug>(x: T) -> usize {
        let mut bytes = Vec::new();
        x.write(&mut bytes);
        let mut rest = Reader { repeats: 1000, ..Reader::new(&bytes) };
        assert_eq!(T::read(&mut rest).as_ref(), Some(&x));
        assert!(rest.is_empty());
        for cut in 0..bytes.len() {
            // Nothing is read of what is cut short.
            assert_eq!(T::read(&mut Reader::new(&bytes[..cut])), None, "{x:?} cut to {cut} of {}", bytes.len());
        }
        bytes.len()
    }

    #[test]
    fn what_is_written_is_read() {
        for x in [0, 1, 127, 128, 1 << 31, u64::MAX] {
            there_and_back(x);
        }
        assert_eq!(there_and_back(127u64), 1);
        for x in [0, -1, 1, i32::MIN, i32::MAX] {
            there_and_back(x);
        }
        there_and_back([-0.0, f64::INFINITY, 5e-324, 0.1]);
        there_and_back(vec![Some(vec![1u32, 2]), None, Some(vec![])]);
        there_and_back(BTreeMap::from([(1u32, vec![3u32]), (7, vec![])]));
        there_and_back(BTreeSet::from([(1u32, 2u32, 3u64)]));
        // All the same: one of them.
        assert_eq!(there_and_back(vec![0.25; 1000]), 2 + 1 + 8);
        assert_eq!(there_and_back(vec![0.25]), 1 + 1 + 8);
    }

    #[test]
    fn lengths_that_lie_are_refused() {
        let mut bytes = Vec::new();
        (u64::MAX, 0u8).write(&mut bytes);
        assert_eq!(Vec::<u64>::read(&mut Reader::new(&bytes)), None);
        let mut bytes = vec![];
        (1u64 << 40).write(&mut bytes);
        bytes.extend([1, 0]);
        assert_eq!(Vec::<u64>::read(&mut Reader::new(&bytes)), None);
    }
}
