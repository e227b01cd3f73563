//! The typed scene as text, for tests and for the curious: a line per thing, an indent per level, SI units.

use super::camera::Fov;
use super::light::EnvironmentRadiance;
use super::material::{Channel, CheckerCells, ColorSpace, Pattern};
use super::{
    Brightness, Camera, Classic, Curve, Exposure, Focus, Handle, Heights, ImageUse, Input, Lens, Light,
    LightKind, Material, MaterialKind, MetalColor, Object, Projection, RevolveMethod, Scene, ShapeKind,
    TextureKind,
};
use crate::math::motion::{Factor, Motion};
use crate::math::{DAffine3, DVec2, DVec3, Rgb};
use crate::source::Spanned;
use std::fmt::Write;

/// The whole scene as text.
pub fn dump(scene: &Scene) -> String {
    let mut out = String::new();
    for param in &scene.params {
        line(&mut out, &format!("param {} = {}", param.name.value, param.value));
    }
    for (handle, texture) in scene.textures.entries() {
        line(&mut out, &format!("texture {handle:?} {}", texture_kind(&texture.kind)));
    }
    for (handle, material) in scene.materials.entries() {
        let name = material.name.as_ref().map_or(String::new(), |name| format!(" `{name}`"));
        line(&mut out, &format!("material {handle:?}{name} {}", material_kind(material)));
    }
    for (handle, shape) in scene.shapes.entries() {
        line(&mut out, &format!("shape {handle:?} {}", shape_kind(&shape.kind)));
    }
    scene.objects.iter().for_each(|object| dump_object(&mut out, scene, object));
    scene.lights.iter().for_each(|light| line(&mut out, &light_text(light)));
    if let Some(environment) = &scene.environment {
        let radiance = match environment.radiance {
            EnvironmentRadiance::Constant(color) => rgb(color),
            EnvironmentRadiance::Image(texture) => format!("texture {texture:?}"),
        };
        let (scale, rotation) = (environment.scale.value, number(environment.rotation));
        line(&mut out, &format!("environment radiance {radiance} scale {scale} rotation {rotation}"));
    }
    scene.cameras.iter().for_each(|camera| dump_camera(&mut out, scene, camera));
    dump_render(&mut out, scene);
    out
}

fn line(out: &mut String, text: &str) {
    out.push_str(text.trim_end());
    out.push('\n');
}

/// Rounded to nine decimals, without a negative zero.
fn number(x: f64) -> String {
    format!("{}", (x * 1e9).round() / 1e9 + 0.0)
}

fn point(p: DVec3) -> String {
    format!("({} {} {})", number(p.x), number(p.y), number(p.z))
}

fn pair(p: DVec2) -> String {
    format!("({} {})", number(p.x), number(p.y))
}

/// Channels rounded to five decimals, which is finer than any display.
fn rgb(color: Rgb) -> String {
    let channel = |x: f32| (f64::from(x) * 1e5).round() / 1e5 + 0.0;
    match color.to_array().map(channel) {
        [r, g, b] if r == g && g == b => format!("{r}"),
        [r, g, b] => format!("rgb({r} {g} {b})"),
    }
}

fn input(input: Input) -> String {
    match input {
        Input::Constant(color) => rgb(color.value),
        Input::Texture(texture) => format!("texture {:?}", texture.value),
    }
}

fn brightness(brightness: Brightness) -> String {
    match brightness {
        Brightness::Power(watts) => format!("power {}", number(watts)),
        Brightness::Radiance(value) => format!("radiance {}", rgb(value)),
        Brightness::Intensity(value) => format!("intensity {}", rgb(value)),
        Brightness::Irradiance(value) => format!("irradiance {}", number(value)),
    }
}

fn texture_kind(kind: &TextureKind) -> String {
    match kind {
        TextureKind::Image(image) => image_text(image),
        TextureKind::Checker(checker) => {
            let cells = match checker.cells {
                CheckerCells::Uv(cells) => format!("cells {}", pair(cells)),
                CheckerCells::Solid(size) => format!("size {}", number(size)),
            };
            format!("checker a {} b {} {cells}", input(checker.a), input(checker.b))
        }
        TextureKind::Pattern { a, b, pattern } => {
            format!("{} a {} b {}", pattern_text(pattern), input(*a), input(*b))
        }
        TextureKind::Blend { a, b, amount } => {
            format!("blend a {} b {} amount {}", input(*a), input(*b), input(*amount))
        }
        TextureKind::Join { op, a, b } => format!("{op:?} {} {}", input(*a), input(*b)).to_lowercase(),
    }
}

fn pattern_text(pattern: &Pattern) -> String {
    match pattern {
        Pattern::Gradient(None) => "gradient".to_owned(),
        Pattern::Gradient(Some([start, end])) => format!("gradient {} {}", point(*start), point(*end)),
        Pattern::Noise { size, octaves } => format!("noise size {} octaves {octaves}", number(*size)),
        Pattern::Marble { size, turbulence } => {
            format!("marble size {} turbulence {}", number(*size), number(*turbulence))
        }
        Pattern::Wood { size, turbulence } => {
            format!("wood size {} turbulence {}", number(*size), number(*turbulence))
        }
        Pattern::Brick { cells, mortar, aspect } => {
            format!("brick {} mortar {} aspect {}", pair(*cells), number(*mortar), number(*aspect))
        }
    }
}

fn image_text(image: &ImageUse) -> String {
    let mut out = format!("image \"{}\" {:?}", image.file.value, image.wrap);
    if !image.linear_filter {
        out.push_str(" nearest");
    }
    if image.skip_missing {
        out.push_str(" skip missing");
    }
    if (image.uv_scale, image.uv_offset) != (DVec2::ONE, DVec2::ZERO) {
        let _ = write!(out, " uv {} + {}", pair(image.uv_scale), pair(image.uv_offset));
    }
    if image.uv_rotation != 0.0 {
        let _ = write!(out, " turned {}", number(image.uv_rotation));
    }
    if (image.space, image.channel) != (ColorSpace::Auto, Channel::Rgb) {
        let _ = write!(out, " {:?} {:?}", image.space, image.channel);
    }
    match image.projection {
        Projection::Uv => {}
        Projection::Planar { origin, u, v } => {
            let _ = write!(out, " planar {} u {} v {}", point(origin), point(u), point(v));
        }
        Projection::Spherical { center } => {
            let _ = write!(out, " spherical {}", point(center));
        }
        Projection::Cubic { center, size } => {
            let _ = write!(out, " cubic {} size {}", point(center), point(size));
        }
    }
    out
}

fn material_kind(material: &Material) -> String {
    match &material.kind {
        MaterialKind::Diffuse { color } => format!("diffuse {}", input(*color)),
        MaterialKind::Phong { diffuse, specular, shininess } => {
            format!("phong {} specular {} shininess {}", input(*diffuse), input(*specular), shininess.value)
        }
        MaterialKind::Mirror { color } => format!("mirror {}", input(*color)),
        MaterialKind::Metal { color, roughness } => {
            let color = match color {
                MetalColor::Named { name, straight, edge } => {
                    format!("{} {} edge {}", name.value, rgb(*straight), rgb(*edge))
                }
                MetalColor::Color { straight, edge } => format!("{} edge {}", input(*straight), input(*edge)),
            };
            format!("metal {color} roughness {}", input(*roughness))
        }
        MaterialKind::Glass { ior, roughness, tint, absorption, abbe, thin, priority } => {
            let mut text =
                format!("glass ior {} tint {} absorption {}", ior.value, rgb(tint.value), rgb(*absorption));
            if !matches!(roughness, Input::Constant(color) if color.is_black()) {
                let _ = write!(text, " roughness {}", input(*roughness));
            }
            if let Some(abbe) = abbe {
                let _ = write!(text, " abbe {}", number(abbe.value));
            }
            if thin.is_some() {
                text.push_str(" thin");
            }
            if *priority != 0 {
                let _ = write!(text, " priority {priority}");
            }
            text
        }
        MaterialKind::Plastic { color, ior, roughness } => {
            format!("plastic {} ior {} roughness {}", input(*color), ior.value, input(*roughness))
        }
        MaterialKind::Layer { base, ior, roughness, cover } => {
            format!(
                "layer {base:?} ior {} roughness {} cover {}",
                ior.value,
                input(*roughness),
                input(*cover)
            )
        }
        MaterialKind::Principled(of) => format!(
            "principled {} metallic {} roughness {} transmission {} ior {} clearcoat {} {} emission {}",
            input(of.color),
            input(of.metallic),
            input(of.roughness),
            input(of.transmission),
            of.ior.value,
            input(of.clearcoat),
            input(of.clearcoat_roughness),
            match of.emission {
                Input::Constant(emission) => rgb(emission.value),
                map @ Input::Texture(_) => input(map),
            }
        ),
        MaterialKind::Mask { base, opacity, cutoff } => {
            let cutoff = cutoff.map_or(String::new(), |cutoff| format!(" cutoff {}", number(cutoff)));
            format!("mask {base:?} opacity {}{cutoff}", input(*opacity))
        }
        MaterialKind::TwoSided { front, back } => format!("two_sided {front:?} {back:?}"),
        MaterialKind::NormalMap { base, map, strength } => {
            format!("normal_map {base:?} texture {:?} strength {}", map.value, number(*strength))
        }
        MaterialKind::Bump { base, height, depth } => {
            format!("bump {base:?} texture {:?} depth {}", height.value, number(*depth))
        }
        MaterialKind::Emissive { brightness: b, map, color } => {
            let map = map.map_or(String::new(), |map| format!(" texture {:?}", map.value));
            format!("emissive {}{map} color {}", brightness(b.value), rgb(*color))
        }
        MaterialKind::Whitted { diffuse, specular, shininess, reflection, transmission, ior, fresnel } => {
            format!(
                "whitted {} specular {} shininess {} reflection {} transmission {} ior {} fresnel {fresnel}",
                input(*diffuse),
                input(*specular),
                shininess.value,
                input(*reflection),
                input(*transmission),
                ior.value
            )
        }
        MaterialKind::Mix { a, b, amount } => format!("mix {a:?} {b:?} amount {}", input(*amount)),
    }
}

fn shape_kind(kind: &ShapeKind) -> String {
    match kind {
        ShapeKind::Sphere { center, radius } => {
            format!("sphere {} radius {}", point(*center), number(radius.value))
        }
        ShapeKind::Plane { normal, offset } => {
            format!("plane {} offset {}", point(normal.value), number(*offset))
        }
        ShapeKind::Disk { center, normal, radius } => {
            format!("disk {} normal {} radius {}", point(*center), point(normal.value), number(radius.value))
        }
        ShapeKind::Quad { origin, edge_u, edge_v } => {
            format!("quad {} u {} v {}", point(*origin), point(edge_u.value), point(edge_v.value))
        }
        ShapeKind::Box { min, max } => format!("box {} {}", point(min.value), point(max.value)),
        ShapeKind::Triangle { corners: [a, b, c] } => {
            format!("triangle {} {} {}", point(a.value), point(b.value), point(c.value))
        }
        ShapeKind::Mesh { file, part, scale, smooth, skip_missing } => {
            let part = part.as_ref().map_or(String::new(), |part| format!(" part \"{}\"", part.value));
            let file = &file.value;
            format!("mesh \"{file}\"{part} scale {} smooth {smooth:?} skip {skip_missing}", scale.value)
        }
        ShapeKind::Cone { base, axis, radius, top_radius, caps } => {
            let top = top_radius.map_or(String::new(), |top| format!(" top {}", number(top.value)));
            let open = if *caps { "" } else { " open" };
            let (base, axis) = (point(*base), point(axis.value));
            format!("cone {base} axis {axis} radius {}{top}{open}", number(radius.value))
        }
        ShapeKind::Torus { center, normal, radius, tube } => {
            let (center, normal) = (point(*center), point(normal.value));
            format!(
                "torus {center} normal {normal} radius {} tube {}",
                number(radius.value),
                number(tube.value)
            )
        }
        ShapeKind::Sweep { path, radius, end_radius, caps, closed, tolerance } => {
            let mut out = format!("sweep {caps:?} radius {}", number(radius.value));
            if let Some(end) = end_radius {
                let _ = write!(out, " to {}", number(end.value));
            }
            if let Some(tolerance) = tolerance {
                let _ = write!(out, " tolerance {}", number(tolerance.value));
            }
            let points: Vec<String> = path.points.iter().map(|&p| point(p)).collect();
            let closed = if *closed { " closed" } else { "" };
            format!("{out}{closed} {:?} {}", path.kind, points.join(" "))
        }
        ShapeKind::Heightfield { heights, size, smooth } => {
            let heights = match heights {
                Heights::Image(texture) => format!("texture {:?}", texture.value),
                Heights::Grid { width, values, .. } => {
                    let values: Vec<String> = values.iter().map(|&v| number(f64::from(v))).collect();
                    format!("{width} wide {}", values.join(" "))
                }
            };
            format!("heightfield {} smooth {smooth} {heights}", point(size.value))
        }
        ShapeKind::Revolve { profile, method } => {
            let method = match method {
                RevolveMethod::Exact => "exact".to_owned(),
                RevolveMethod::Tessellated(None) => "tessellated".to_owned(),
                RevolveMethod::Tessellated(Some(tolerance)) => {
                    format!("tessellated {}", number(tolerance.value))
                }
            };
            format!("revolve {method} {}", curve(profile))
        }
        ShapeKind::Extrude { outline, holes, depth, tolerance } => {
            let tolerance = tolerance.map_or(String::new(), |t| format!(" tolerance {}", number(t.value)));
            let holes: String = holes.iter().map(|hole| format!(" hole {}", curve(hole))).collect();
            format!("extrude depth {}{tolerance} {}{holes}", number(depth.value), curve(outline))
        }
    }
}

fn curve(curve: &Curve) -> String {
    let points: Vec<String> = curve.points.iter().map(|&p| pair(p)).collect();
    format!("{:?} {}", curve.kind, points.join(" "))
}

fn dump_object(out: &mut String, scene: &Scene, object: &Object) {
    let material = object.material.map_or(String::new(), |m: Handle<Material>| format!(" material {m:?}"));
    let names: String =
        object.names.iter().map(|&id| format!(" `{}`", scene.names[id as usize].name.value)).collect();
    line(out, &format!("object shape {:?}{material}{names}", object.shape));
    let m = object.world_from_object;
    if m != DAffine3::IDENTITY {
        let columns = [m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis, m.translation].map(point);
        line(out, &format!("    world {}", columns.join(" ")));
    }
    if let Some(motion) = &object.motion {
        dump_motion(out, motion);
    }
}

/// Where it has moved to when the frame ends, and the factors that lead there.
fn dump_motion(out: &mut String, motion: &Motion) {
    for factor in motion.factors() {
        match *factor {
            Factor::Straight { .. } if factor.is_still() => line(out, "    motion still"),
            Factor::Straight { .. } => line(out, "    motion straight"),
            Factor::Turn { axis, from, to } => {
                line(
                    out,
                    &format!("    motion about {} from {} to {}", point(axis), number(from), number(to)),
                );
            }
        }
    }
    let m = motion.at(1.0);
    let columns = [m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis, m.translation].map(point);
    line(out, &format!("    ends {}", columns.join(" ")));
}

fn light_text(light: &Light) -> String {
    let kind = match light.kind {
        LightKind::Point { position, falloff } if falloff.value == LightKind::PHYSICAL => {
            format!("point {}", point(position))
        }
        LightKind::Point { position, falloff } => {
            format!("point {} falloff {:?}", point(position), falloff.value)
        }
        LightKind::Sphere { center, radius } => {
            format!("sphere {} radius {}", point(center), number(radius.value))
        }
        LightKind::Rect { origin, edge_u, edge_v, two_sided } => {
            let sides = if two_sided { " two-sided" } else { "" };
            format!("rect {} u {} v {}{sides}", point(origin), point(edge_u), point(edge_v))
        }
        LightKind::Spot { position, direction, angle, blend, falloff } => {
            let (position, direction) = (point(position), point(direction.value));
            let fades = match falloff.value == LightKind::PHYSICAL {
                true => String::new(),
                false => format!(" falloff {:?}", falloff.value),
            };
            let (angle, blend) = (number(angle.value), number(blend.value));
            format!("spot {position} direction {direction} angle {angle} blend {blend}{fades}")
        }
        LightKind::Disk { center, edge_u, edge_v, two_sided, .. } => {
            let sides = if two_sided { " two-sided" } else { "" };
            format!("disk {} u {} v {}{sides}", point(center), point(edge_u), point(edge_v))
        }
        LightKind::SunSky(ref day) => {
            let (sun, size) = (point(day.to_sun.value), number(day.sun_size.value));
            let disc = if day.sun { format!("size {size}") } else { "hidden".to_owned() };
            format!(
                "sun_sky {sun} {disc} turbidity {} ground {}",
                number(day.turbidity.value),
                rgb(day.ground)
            )
        }
        LightKind::Directional { direction } => format!("directional {}", point(direction.value)),
    };
    format!("light {kind} {} color {}", brightness(light.brightness.value), rgb(light.color))
}

fn dump_camera(out: &mut String, scene: &Scene, camera: &Camera) {
    let name = camera.name.as_ref().map_or(String::new(), |name| format!(" {}", name.value));
    line(out, &format!("camera{name}"));
    let (position, direction, up) = (camera.position.value, camera.direction.value, camera.up.value);
    line(out, &format!("    position {} direction {} up {}", point(position), point(direction), point(up)));
    match camera.fov.map(|fov| fov.value) {
        Some(Fov::Vertical(angle)) => line(out, &format!("    fov {}", number(angle))),
        Some(Fov::Horizontal(angle)) => line(out, &format!("    fov_x {}", number(angle))),
        None => {}
    }
    line(out, &format!("    {}", lens(scene, &camera.lens)));
    let film = &camera.film;
    let exposure = match film.exposure.value {
        Exposure::Auto => "auto".to_owned(),
        Exposure::Ev(steps) => format!("{}EV", number(steps)),
    };
    let ((width, height), filter, tone) = (film.size.value, film.filter.value, film.tone.value);
    let sensor = number(film.sensor.value);
    let crop = film.crop.map_or(String::new(), |crop| {
        let [left, top, right, bottom] = crop.value.map(number);
        format!(" crop {left} {top} {right} {bottom}")
    });
    let stretch = match film.pixel_aspect.value {
        1.0 => String::new(),
        aspect => format!(" pixel_aspect {}", number(aspect)),
    };
    line(
        out,
        &format!(
            "    film {width} x {height}{crop}{stretch} {filter:?} sensor {sensor} exposure {exposure} {tone:?}"
        ),
    );
}

fn focus_text(scene: &Scene, focus: Option<&Spanned<Focus>>) -> String {
    match focus.map(|focus| &focus.value) {
        None => "nothing".to_owned(),
        Some(Focus::Distance(distance)) => number(*distance),
        Some(Focus::Point(p)) => point(*p),
        Some(Focus::On(id, _)) => format!("on `{}`", scene.names[*id as usize].name.value),
    }
}

fn shift_text(shift: DVec2) -> String {
    if shift == DVec2::ZERO { String::new() } else { format!(" shift {}", pair(shift)) }
}

fn lens(scene: &Scene, lens: &Lens) -> String {
    match lens {
        Lens::Pinhole { focal_length, shift } => {
            let length = focal_length
                .map_or(String::new(), |length| format!(" focal_length {}", number(length.value)));
            format!("pinhole{length}{}", shift_text(*shift))
        }
        Lens::Thin { focal_length, radius, focus, blades, rotation, anamorphic, cat_eye, shift, tilt } => {
            let length = focal_length
                .map_or(String::new(), |length| format!(" focal_length {}", number(length.value)));
            let focus = focus_text(scene, focus.as_ref());
            let mut more = shift_text(*shift);
            for (name, value, usual) in [
                ("anamorphic", anamorphic, 1.0),
                ("cat_eye", cat_eye, 0.0),
                ("tilt", &tilt[0], 0.0),
                ("swing", &tilt[1], 0.0),
            ] {
                if value.value != usual {
                    let _ = write!(more, " {name} {}", number(value.value));
                }
            }
            let (blades, rotation) = (blades.value, number(rotation.value));
            format!(
                "thin{length} radius {} focus {focus} blades {blades} rotation {rotation}{more}",
                number(radius.value)
            )
        }
        Lens::Orthographic { size, is_width } => {
            format!("orthographic {} {}", if *is_width { "width" } else { "height" }, number(size.value))
        }
        Lens::Panorama { width, height } => {
            format!("panorama {} x {}", number(width.value), number(height.value))
        }
        Lens::Fisheye { angle, mapping, full } => {
            format!("fisheye {} {mapping:?}{}", number(angle.value), if *full { " full" } else { "" })
        }
        Lens::Prescription { file, aperture, focus } => {
            let aperture = aperture.map_or(String::new(), |n| format!(" aperture f/{}", number(n.value)));
            let focus = focus_text(scene, focus.as_ref());
            format!("prescription \"{}\"{aperture} focus {focus}", file.value)
        }
    }
}

fn dump_render(out: &mut String, scene: &Scene) {
    let render = &scene.render;
    let mut parts = Vec::new();
    let mut part = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            parts.push(format!(" {name} {value}"));
        }
    };
    part("method", render.method.map(|method| format!("{:?}", method.value).to_lowercase()));
    part("passes", render.stop.passes.map(|passes| passes.value.to_string()));
    part("seconds", render.stop.seconds.map(|seconds| number(seconds.value)));
    part("error", render.stop.error.map(|error| number(error.value)));
    part("depth", render.depth.map(|depth| depth.value.to_string()));
    part("seed", render.seed.map(|seed| seed.value.to_string()));
    part("photons", render.photons.count.map(|count| count.value.to_string()));
    part("k", render.photons.k.map(|k| k.value.to_string()));
    part("radius", render.photons.radius.map(|radius| number(radius.value)));
    part("classic", (render.classic != Classic::default()).then(|| format!("{:?}", render.classic)));
    part("shrink", render.photons.shrink.map(|shrink| number(shrink.value)));
    if !parts.is_empty() {
        line(out, &format!("render{}", parts.concat()));
    }
}
