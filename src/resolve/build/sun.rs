//! Where the sun stands. North is −z, east is +x, up is +y.

use crate::math::DVec3;
use crate::math::float::sin_cos64;
use std::f64::consts::{PI, TAU};

/// The unit direction to a point of the sky, in radians above the horizon and from the north by the east.
pub fn by_angles(elevation: f64, azimuth: f64) -> DVec3 {
    let ((up, flat), (east, north)) = (sin_cos64(elevation), sin_cos64(azimuth));
    DVec3::new(flat * east, up, -flat * north)
}

/// The unit direction to the sun at a latitude and longitude (radians; north and east positive), on a day of the year, at
/// an hour of a clock that is `zone` hours ahead of UTC.
///
/// Good to half a degree (Preetham et al. 1999, appendix A.6).
pub fn by_place_and_time(latitude: f64, longitude: f64, day: f64, hour: f64, zone: f64) -> DVec3 {
    let sin = |x: f64| sin_cos64(x).0;
    let hours_east = longitude * 12.0 / PI;
    let equation = 0.170 * sin(4.0 * PI * (day - 80.0) / 373.0) - 0.129 * sin(TAU * (day - 8.0) / 355.0);
    let solar = hour + equation + hours_east - zone;
    let declination = 0.4093 * sin(TAU * (day - 81.0) / 368.0);
    // From the midnight meridian by the east; in the frame of the equator, then tilted by the latitude.
    let (sin_hour, cos_hour) = sin_cos64(PI * solar / 12.0);
    let ((sin_d, cos_d), (sin_l, cos_l)) = (sin_cos64(declination), sin_cos64(latitude));
    let up = sin_l * sin_d - cos_l * cos_d * cos_hour;
    let north = cos_l * sin_d + sin_l * cos_d * cos_hour;
    DVec3::new(cos_d * sin_hour, up, -north)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn angles(v: DVec3) -> (f64, f64) {
        (libm::asin(v.y).to_degrees(), libm::atan2(v.x, -v.z).to_degrees().rem_euclid(360.0))
    }

    #[test]
    fn angles_come_back() {
        let (elevation, azimuth) = angles(by_angles(0.5, 2.0));
        assert!(
            (elevation - 0.5_f64.to_degrees()).abs() < 1e-9 && (azimuth - 2.0_f64.to_degrees()).abs() < 1e-9
        );
    }

    #[test]
    fn the_sun_is_where_almanacs_say() {
        // At the summer solstice noon stands 23.4° nearer to the zenith than at the equinox, in the south.
        let (elevation, azimuth) = angles(by_place_and_time(48.0_f64.to_radians(), 0.0, 172.0, 12.03, 0.0));
        assert!((elevation - 65.4).abs() < 0.5 && (azimuth - 180.0).abs() < 2.0, "{elevation} {azimuth}");
        // South of the equator it stands in the north.
        let (_, azimuth) = angles(by_place_and_time(-34.0_f64.to_radians(), 0.0, 172.0, 12.0, 0.0));
        assert!(!(10.0..350.0).contains(&azimuth), "{azimuth}");
        // In the morning in the east, in the evening in the west, at midnight below.
        let at = |hour| by_place_and_time(0.7, 0.0, 81.0, hour, 0.0);
        assert!(at(7.0).x > 0.5 && at(17.0).x < -0.5 && at(0.0).y < -0.5);
    }
}
