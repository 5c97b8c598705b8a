//! One picture as PNG.
use crate::raster::Canvas;
use std::io::{self, Write};

/// Writes a canvas as PNG, three bytes a pixel.
///
/// # Errors
/// What the writer says.
pub fn png(canvas: &Canvas, out: &mut impl Write) -> io::Result<()> {
    let [width, height] = canvas.size();
    let mut encoder = png::Encoder::new(out, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    let mut writer = encoder.write_header()?;
    let rgb: Vec<u8> = canvas.pixels().chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(())
}
