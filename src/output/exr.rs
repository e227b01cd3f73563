//! OpenEXR: radiance, its standard error, the number of samples and further layers as channels of one file.

use super::Frame;
use crate::math::Rgb;
use exr::prelude::*;
use std::io::{Seek, Write};

/// Writes the picture: channels `R G B`, `error.R error.G error.B` where the standard error is known, `samples` where
/// the numbers of samples are, and the planes by their names.
pub fn encode(out: &mut (impl Write + Seek), frame: &Frame) -> std::io::Result<()> {
    let plane = |pixels: &[Rgb], channel: usize| {
        FlatSamples::F32(pixels.iter().map(|pixel| pixel[channel]).collect())
    };
    let mut channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = SmallVec::new();
    for (index, name) in ["R", "G", "B"].into_iter().enumerate() {
        channels.push(AnyChannel::new(name, plane(&frame.radiance, index)));
        if !frame.standard_error.is_empty() {
            let name = format!("error.{name}");
            channels.push(AnyChannel::new(Text::from(name.as_str()), plane(&frame.standard_error, index)));
        }
    }
    if !frame.sample_counts.is_empty() {
        channels.push(AnyChannel::new("samples", FlatSamples::U32(frame.sample_counts.clone())));
    }
    for plane in &frame.planes {
        let samples = FlatSamples::F32(plane.samples.clone());
        channels.push(AnyChannel::new(Text::from(plane.name.as_str()), samples));
    }
    let software_name = Some(Text::from(concat!("snell ", env!("CARGO_PKG_VERSION"))));
    let mut attributes = LayerAttributes { software_name, ..LayerAttributes::default() };
    for (name, value) in &frame.facts {
        attributes.other.insert(Text::from(name.as_str()), AttributeValue::Text(Text::from(value.as_str())));
    }
    let size = (frame.width as usize, frame.height as usize);
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels));
    Image::from_layer(layer).write().to_buffered(out).map_err(std::io::Error::other)
}
