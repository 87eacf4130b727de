use super::table_error::TableError;
use crate::math::Ray;
use glam::DVec3;

const COLUMNS: [&str; 6] = ["ox", "oy", "oz", "dx", "dy", "dz"];

/// The rays of a CSV text whose header names the columns `ox` to `dz` and optionally `tmin`. Other columns, empty lines and
/// lines that start with `#` are ignored.
pub(super) fn read(text: &str) -> Result<Vec<Ray>, TableError> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let (k, header) = lines.next().unwrap_or((0, ""));
    let header: Vec<&str> = header.split(',').map(str::trim).collect();
    let column_of = |name: &str| header.iter().position(|column| *column == name);
    let mut columns = [0; 6];
    for (column, name) in columns.iter_mut().zip(COLUMNS) {
        let problem = || format!("the header has no column `{name}`");
        *column = column_of(name).ok_or_else(|| TableError { line: k + 1, problem: problem() })?;
    }
    let t_min = column_of("tmin");
    lines.map(|(k, line)| ray(line, &columns, t_min).map_err(|problem| TableError { line: k + 1, problem })).collect()
}

fn ray(line: &str, columns: &[usize; 6], t_min: Option<usize>) -> Result<Ray, String> {
    let fields: Vec<&str> = line.split(',').map(str::trim).collect();
    let number = |column: usize, name: &str| {
        let field = fields.get(column).copied().unwrap_or_default();
        let number = field.parse().ok().filter(|x: &f64| x.is_finite());
        number.ok_or_else(|| format!("expected a finite number for {name}, found `{field}`"))
    };
    let mut numbers = [0.0; 6];
    for (k, value) in numbers.iter_mut().enumerate() {
        *value = number(columns[k], COLUMNS[k])?;
    }
    let [ox, oy, oz, dx, dy, dz] = numbers;
    let direction = DVec3::new(dx, dy, dz);
    if direction == DVec3::ZERO {
        return Err("the direction of a ray must not be zero".to_owned());
    }
    // An empty field stands for 0.
    let t_min = match t_min.filter(|&column| fields.get(column).is_some_and(|field| !field.is_empty())) {
        Some(column) => number(column, "tmin")?,
        None => 0.0,
    };
    Ok(Ray { t_min, ..Ray::new(DVec3::new(ox, oy, oz), direction) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_columns_by_name_and_says_where_they_are_wrong() {
        let rays = read("# rays\nid,dz,oy,oz,dx,dy,ox,tmin\n7,1,2,3,4,5,6,0.25\n8,1,2,3,4,5,6,\n").unwrap();
        assert_eq!(rays[0], Ray { t_min: 0.25, ..Ray::new(DVec3::new(6.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 1.0)) });
        assert_eq!(rays[1].t_min, 0.0);
        let error = |text: &str| read(text).unwrap_err().to_string();
        assert_eq!(error("ox,oy,oz,dx,dy\n"), "line 1: the header has no column `dz`");
        let header = "ox,oy,oz,dx,dy,dz";
        assert_eq!(error(&format!("{header}\n1,2,3,4,5\n")), "line 2: expected a finite number for dz, found ``");
        assert_eq!(error(&format!("{header}\n1,2,3,0,0,0\n")), "line 2: the direction of a ray must not be zero");
    }
}
