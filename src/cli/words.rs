/// A number with its noun: `1 iteration`, `2 iterations`, `3 patches`.
pub(super) fn counted(n: u64, word: &str) -> String {
    let ending = match n {
        1 => "",
        _ if word.ends_with("ch") => "es",
        _ => "s",
    };
    format!("{n} {word}{ending}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_agree() {
        assert_eq!(counted(1, "iteration"), "1 iteration");
        assert_eq!(counted(0, "iteration"), "0 iterations");
        assert_eq!(counted(2, "Bezier patch"), "2 Bezier patches");
    }
}
