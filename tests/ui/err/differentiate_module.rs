use aim::differentiate;

#[differentiate]
mod model {
    use aim::glam::{Quat, Vec3};

    pub struct Spring {
        pub stiffness: f32,
        pub name: String,
        pub rest: f32,
    }

    impl Spring {
        fn energy(&self, x: f32) -> f32 {
            0.5 * self.stiffness * (x - self.rest).powi(2)
        }
    }

    // One error, though it is called twice and in two functions.
    fn helper(x: f32) -> f32 {
        x.next_up()
    }

    fn factorial(x: f32, n: usize) -> f32 {
        if n == 0 { x } else { n as f32 * factorial(x, n - 1) }
    }

    #[differentiate(wrt(x))]
    pub fn recursive(x: f32, n: usize) -> f32 {
        factorial(x, n) + helper(x) + helper(2.0 * x)
    }

    #[differentiate(wrt(x))]
    pub fn again(x: f32) -> f32 {
        helper(x)
    }

    fn repeated<const N: usize>(x: f32) -> [f32; N] {
        [x; N]
    }

    #[differentiate(wrt(x))]
    pub fn inferred_later(x: f32) -> f32 {
        let all = repeated(x);
        let [one, other] = all;
        one * other
    }

    pub struct Steps(pub [f32; 4]);

    #[differentiate(wrt(x))]
    pub fn assigned(x: f32) -> f32 {
        let mut steps = Steps([x; 4]);
        steps[0..2] = [x; 2];
        steps.0[1]
    }

    #[differentiate(wrt(x), budget = 1)]
    pub fn fields(x: f32, spring: &Spring) -> f32 {
        spring.energy(x) + spring.name.len() as f32
    }

    #[differentiate(wrt(x), lanes, check = true)]
    pub fn unchecked(x: f32, spring: &Spring) -> f32 {
        spring.energy(x)
    }

    #[differentiate(wrt(spring, flag, p))]
    pub fn variables(spring: Spring, flag: bool, p: &[Vec3]) -> f32 {
        if flag { spring.rest } else { p[0].x }
    }

    #[differentiate(wrt(x))]
    pub fn whole(x: f32) -> Spring {
        Spring { stiffness: x, name: String::new(), rest: x }
    }

    pub struct Counted {
        pub x: f32,
        pub n: usize,
    }

    #[differentiate(wrt(x))]
    pub fn counted(x: f32) -> (f32, Counted) {
        (x, Counted { x, n: 1 })
    }
}

#[differentiate]
mod unseen {
    #[cfg(windows)]
    const GAIN: f32 = 2.0;
    #[cfg(not(windows))]
    const GAIN: f32 = 3.0;

    trait Total {
        fn sum(&self) -> f32;
    }

    impl Total for [f32; 2] {
        fn sum(&self) -> f32 {
            self[0] - self[1]
        }
    }

    #[differentiate(wrt(x))]
    pub fn conditional(x: f32) -> f32 {
        x * GAIN
    }

    #[differentiate(wrt(x))]
    pub fn conditional_inside(x: f32) -> f32 {
        #[cfg(any())]
        let x = 2.0 * x;
        x
    }

    #[differentiate(wrt(x))]
    pub fn total(x: f32) -> f32 {
        [x, 2.0].sum()
    }

    #[differentiate(wrt(x))]
    pub fn optional(x: f32, limit: Option<f32>, name: Option<&str>) -> Option<bool> {
        let _ = name;
        if let Some(limit) = limit { Some(x < limit) } else { None }
    }

    pub struct Joint {
        pub turn: Quat,
        pub length: Option<f32>,
    }

    #[differentiate(wrt(tangent(joint)))]
    pub fn turned(joint: &Joint) -> f32 {
        joint.turn.x * joint.length.unwrap_or(1.0)
    }

    #[differentiate(wrt(x), lanes)]
    pub fn root(x: f32) -> Option<f32> {
        if x > 0.0 { Some(x.sqrt()) } else { None }
    }

    pub enum Length {
        Unit,
        Of(f32),
    }

    #[differentiate(wrt(length), lanes)]
    pub fn square(length: Length) -> f32 {
        match length {
            Length::Unit => 1.0,
            Length::Of(x) => x * x,
        }
    }

    // Its default is seen by nobody.
    #[derive(Clone, Copy)]
    pub struct Gains {
        pub near: f32,
        pub far: f32,
    }

    struct Weight(f32);

    impl From<f32> for Weight {
        fn from(x: f32) -> Self {
            Self(x)
        }
    }

    impl<'a> From<&'a f32> for Weight {
        fn from(x: &'a f32) -> Self {
            Self(2.0 * *x)
        }
    }

    #[differentiate(wrt(x))]
    pub fn defaults(x: f32) -> f32 {
        let gains = Gains { near: x, ..Default::default() };
        let far = 2.0 * f32::from(std::convert::identity::<u8>(Default::default()));
        gains.near * gains.far + far + Weight::from(x).0
    }
}

impl Default for unseen::Gains {
    fn default() -> Self {
        Self { near: 2.0, far: 3.0 }
    }
}

#[differentiate]
mod not_understood {
    pub enum Loss {
        Huber(f32),
        Square,
    }

    fn rho(_loss: Loss, x: f32) -> f32 {
        x * x
    }

    #[differentiate(wrt(x))]
    pub fn by_case(x: f32) -> f32 {
        rho(Loss::Huber(0.5), x)
    }

    #[differentiate(wrt(x))]
    pub fn by_name(x: f32) -> f32 {
        rho(Loss::Square, x)
    }
}

#[differentiate(wrt(x))]
mod misplaced {
    #[differentiate(wrt(x))]
    pub fn square(x: f32) -> f32 {
        x * x
    }
}

#[differentiate]
mod idle {
    pub fn square(x: f32) -> f32 {
        x * x
    }
}

#[differentiate]
mod of_methods {
    pub struct Disk {
        pub radius: f32,
    }

    impl Disk {
        #[differentiate(wrt(scale))]
        pub fn area(&self, scale: f32) -> f32 {
            scale * self.radius * self.radius
        }
    }
}

#[differentiate]
mod repeatedly {
    #[differentiate(wrt(x))]
    #[differentiate(wrt(x), hessian)]
    pub fn square(x: f32) -> f32 {
        x * x
    }
}

fn main() {
    let _ = of_methods::Disk { radius: 1.0 }.area(2.0);
    let _ = (misplaced::square_gradient(1.0), idle::square(1.0));
}
