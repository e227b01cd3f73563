//! Buffers, views of them, and the typed numbers in those, with every range checked before a byte is read.

use super::container::{Uri, uri};
use super::json::At;
use crate::asset::model::MeshError;
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::rc::Rc;

/// The most elements of an accessor that no buffer backs.
const MOST_ZEROS: u64 = 1 << 24;

/// The bytes of a file's buffers, each read when it is first needed.
pub(super) struct Buffers<'a> {
    root: At<'a>,
    binary: Option<&'a [u8]>,
    open: &'a dyn Fn(&str) -> Result<Vec<u8>, String>,
    known: RefCell<FxHashMap<usize, Result<Bytes<'a>, MeshError>>>,
    files: RefCell<FxHashMap<String, Content>>,
}

/// The bytes of another file, or why there are none.
type Content = Result<Rc<[u8]>, String>;

/// Bytes of the file itself, or of another.
#[derive(Clone)]
enum Bytes<'a> {
    Own(&'a [u8]),
    Read(Rc<[u8]>),
}

impl Bytes<'_> {
    fn as_slice(&self) -> &[u8] {
        match self {
            Self::Own(bytes) => bytes,
            Self::Read(bytes) => bytes,
        }
    }
}

/// A stretch of a buffer.
#[derive(Clone)]
pub(super) struct View<'a> {
    bytes: Bytes<'a>,
    start: usize,
    end: usize,
    stride: Option<usize>,
}

impl View<'_> {
    pub(super) fn as_slice(&self) -> &[u8] {
        &self.bytes.as_slice()[self.start..self.end]
    }
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        root: At<'a>,
        binary: Option<&'a [u8]>,
        open: &'a dyn Fn(&str) -> Result<Vec<u8>, String>,
    ) -> Self {
        Self { root, binary, open, known: RefCell::default(), files: RefCell::default() }
    }

    fn buffer(&self, index: usize) -> Result<Bytes<'a>, MeshError> {
        if let Some(known) = self.known.borrow().get(&index) {
            return known.clone();
        }
        let found = self.root.element("buffers", index).and_then(|buffer| self.read_buffer(&buffer, index));
        self.known.borrow_mut().insert(index, found.clone());
        found
    }

    fn read_buffer(&self, buffer: &At<'a>, index: usize) -> Result<Bytes<'a>, MeshError> {
        let bytes = match buffer.text("uri")? {
            None if index == 0 && self.binary.is_some() => Bytes::Own(self.binary.unwrap_or_default()),
            None => return Err(buffer.wrong("has no bytes")),
            Some(text) => {
                match uri(text).map_err(|reason| buffer.wrong(format!("cannot be read: {reason}")))? {
                    Uri::Data(bytes) => Bytes::Read(bytes.into()),
                    Uri::File(name) => Bytes::Read(self.file(&name).map_err(|reason| {
                        buffer.wrong(format!("is in `{name}`, which cannot be read: {reason}"))
                    })?),
                }
            }
        };
        let (has, says) = (bytes.as_slice().len() as u64, buffer.whole("byteLength")?.unwrap_or(0));
        if has < says {
            return Err(buffer.wrong(format!("has {has} bytes of the {says} that it should have")));
        }
        Ok(bytes)
    }

    fn file(&self, name: &str) -> Content {
        let mut files = self.files.borrow_mut();
        files.entry(name.to_owned()).or_insert_with(|| (self.open)(name).map(Rc::from)).clone()
    }

    /// A view by its index.
    pub(super) fn view(&self, index: usize) -> Result<View<'a>, MeshError> {
        let view = self.root.element("bufferViews", index)?;
        let buffer = view.refer("buffer", &self.root, "buffers")?;
        let bytes = self.buffer(buffer.ok_or_else(|| view.wrong("has no `buffer`"))?)?;
        let start = view.whole("byteOffset")?.unwrap_or(0);
        let length = view.whole("byteLength")?.unwrap_or(0);
        let has = bytes.as_slice().len() as u64;
        if start.saturating_add(length) > has {
            let reason = format!("ends at byte {}, and its buffer has {has}", start.saturating_add(length));
            return Err(view.wrong(reason));
        }
        let stride = view.whole("byteStride")?.map(|stride| stride as usize);
        Ok(View { bytes, start: start as usize, end: (start + length) as usize, stride })
    }

    /// The accessor that a field points to; `None` without the field.
    pub(super) fn refer(&self, from: &At<'_>, name: &str) -> Result<Option<Accessor<'a>>, MeshError> {
        let index = from.refer(name, &self.root, "accessors")?;
        index.map(|index| self.accessor(index)).transpose()
    }

    fn accessor(&self, index: usize) -> Result<Accessor<'a>, MeshError> {
        let at = self.root.element("accessors", index)?;
        let kind = Kind::of(&at)?;
        let width = match at.text("type")? {
            Some("SCALAR") => 1,
            Some("VEC2") => 2,
            Some("VEC3") => 3,
            Some("VEC4" | "MAT2") => 4,
            Some("MAT3") => 9,
            Some("MAT4") => 16,
            _ => return Err(at.wrong("has no known `type`")),
        };
        let count = at.whole("count")?.ok_or_else(|| at.wrong("has no `count`"))?;
        let source = match at.refer("bufferView", &self.root, "bufferViews")? {
            Some(view) => {
                let start = at.whole("byteOffset")?.unwrap_or(0);
                Some(Source::new(self.view(view)?, start, count, kind.size() * width, &at)?)
            }
            None if at.get("sparse").is_none() => return Err(at.wrong("has no `bufferView`")),
            None if count > MOST_ZEROS => return Err(at.wrong(format!("claims {count} elements"))),
            None => None,
        };
        let is_normalized = at.flag("normalized")?;
        let mut this = Accessor {
            path: at.path.clone(),
            count: count as usize,
            width,
            kind,
            is_normalized,
            source,
            sparse: None,
        };
        if let Some(sparse) = at.get("sparse") {
            this.sparse = Some(self.sparse(&sparse, &this)?);
        }
        Ok(this)
    }

    fn sparse(&self, at: &At<'a>, of: &Accessor<'a>) -> Result<Sparse<'a>, MeshError> {
        let count = at.whole("count")?.ok_or_else(|| at.wrong("has no `count`"))?;
        if count > of.count as u64 {
            return Err(at.wrong(format!("claims {count} elements of {}", of.count)));
        }
        let source = |part: &At<'a>, size: usize| {
            let view = part.refer("bufferView", &self.root, "bufferViews")?;
            let view = self.view(view.ok_or_else(|| part.wrong("has no `bufferView`"))?)?;
            Source::new(view, part.whole("byteOffset")?.unwrap_or(0), count, size, part)
        };
        let (indices, values) = (at.need("indices")?, at.need("values")?);
        let kind = Kind::of(&indices)?;
        let places = source(&indices, kind.size())?;
        let mut slots = Vec::with_capacity(count as usize);
        for i in 0..count as usize {
            let place =
                kind.whole(places.element(i)).ok_or_else(|| indices.wrong("are not whole numbers"))?;
            if place as usize >= of.count {
                return Err(indices.wrong(format!("name element {place} of {}", of.count)));
            }
            slots.push((place, i));
        }
        slots.sort_unstable();
        Ok(Sparse { slots, values: source(&values, of.kind.size() * of.width)? })
    }
}

/// The types of components.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Kind {
    fn of(at: &At<'_>) -> Result<Self, MeshError> {
        Ok(match at.whole("componentType")? {
            Some(5120) => Self::I8,
            Some(5121) => Self::U8,
            Some(5122) => Self::I16,
            Some(5123) => Self::U16,
            Some(5125) => Self::U32,
            Some(5126) => Self::F32,
            _ => return Err(at.wrong("has no known `componentType`")),
        })
    }

    const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    fn whole(self, b: &[u8]) -> Option<u32> {
        Some(match self {
            Self::U8 => u32::from(b[0]),
            Self::U16 => u32::from(u16::from_le_bytes([b[0], b[1]])),
            Self::U32 => u32::from_le_bytes([b[0], b[1], b[2], b[3]]),
            Self::I8 | Self::I16 | Self::F32 => return None,
        })
    }

    /// The number, or where `is_normalized` the share of the largest one (glTF 2.0, section 3.11).
    fn float(self, b: &[u8], is_normalized: bool) -> f32 {
        let (value, most) = match self {
            Self::I8 => (f32::from(b[0].cast_signed()), 127.0),
            Self::U8 => (f32::from(b[0]), 255.0),
            Self::I16 => (f32::from(i16::from_le_bytes([b[0], b[1]])), 32_767.0),
            Self::U16 => (f32::from(u16::from_le_bytes([b[0], b[1]])), 65_535.0),
            Self::U32 => (u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as f32, 4_294_967_295.0),
            Self::F32 => return f32::from_le_bytes([b[0], b[1], b[2], b[3]]),
        };
        if is_normalized { (value / most).max(-1.0) } else { value }
    }
}

/// Elements in a view, all within it.
#[derive(Clone)]
struct Source<'a> {
    view: View<'a>,
    start: usize,
    stride: usize,
    size: usize,
}

impl<'a> Source<'a> {
    fn new(view: View<'a>, start: u64, count: u64, size: usize, at: &At<'_>) -> Result<Self, MeshError> {
        let stride = view.stride.unwrap_or(size);
        if stride < size {
            return Err(at.wrong(format!("has elements of {size} bytes every {stride} bytes")));
        }
        let has = view.as_slice().len() as u64;
        let needs = match count.checked_sub(1) {
            None => Some(start),
            Some(others) => {
                others.checked_mul(stride as u64).and_then(|n| n.checked_add(size as u64 + start))
            }
        };
        match needs.filter(|needs| *needs <= has) {
            Some(_) => Ok(Self { view, start: start as usize, stride, size }),
            None => {
                let reason = format!("claims {count} elements of {size} bytes, and its view has {has} bytes");
                Err(at.wrong(reason))
            }
        }
    }

    fn element(&self, index: usize) -> &[u8] {
        let start = self.start + index * self.stride;
        &self.view.as_slice()[start..start + self.size]
    }
}

/// Elements that stand in for some of an accessor's, by their index.
struct Sparse<'a> {
    slots: Vec<(u32, usize)>,
    values: Source<'a>,
}

/// Typed elements.
pub(super) struct Accessor<'a> {
    pub(super) path: String,
    pub(super) count: usize,
    width: usize,
    kind: Kind,
    is_normalized: bool,
    source: Option<Source<'a>>,
    sparse: Option<Sparse<'a>>,
}

impl Accessor<'_> {
    /// Makes sure that elements have this many numbers.
    pub(super) fn of_width(self, widths: &[usize]) -> Result<Self, MeshError> {
        match widths.contains(&self.width) {
            true => Ok(self),
            false => {
                let reason = format!("has elements of {} numbers where {} are needed", self.width, widths[0]);
                Err(MeshError::At { path: self.path, reason })
            }
        }
    }

    fn bytes(&self, index: usize) -> Option<&[u8]> {
        let slot = self.sparse.as_ref().and_then(|sparse| {
            let place = sparse.slots.binary_search_by_key(&(index as u32), |slot| slot.0).ok()?;
            Some(sparse.values.element(sparse.slots[place].1))
        });
        slot.or_else(|| self.source.as_ref().map(|source| source.element(index)))
    }

    /// The first `N` numbers of an element that is there.
    pub(super) fn floats<const N: usize>(&self, index: usize) -> [f32; N] {
        let mut out = [0.0; N];
        if let Some(bytes) = self.bytes(index) {
            let components = bytes.chunks_exact(self.kind.size());
            out.iter_mut().zip(components).for_each(|(x, b)| *x = self.kind.float(b, self.is_normalized));
        }
        out
    }

    /// The elements as indices.
    pub(super) fn indices(&self) -> Result<Vec<u32>, MeshError> {
        let one = |i: usize| match self.bytes(i) {
            Some(bytes) => self.kind.whole(bytes),
            None => Some(0),
        };
        let all: Option<Vec<u32>> = (0..self.count).map(one).collect();
        all.ok_or_else(|| MeshError::At {
            path: self.path.clone(),
            reason: "has indices that are not unsigned whole numbers".to_owned(),
        })
    }
}
