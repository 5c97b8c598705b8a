//! The words, in every language side by side, so that none can be left untranslated.
//!
//! Between `$` stand formulas (as [`Formula::parse`] reads them, with relations between), `{name}` is a place for a quantity.
use super::{Formula, Inline};
use core::str::FromStr;

/// A language of the chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Brazilian Portuguese, with a decimal comma.
    Portuguese,
}

impl Language {
    /// All languages.
    pub const ALL: [Language; 2] = [Language::English, Language::Portuguese];

    /// The tag: en, pt-BR.
    pub fn tag(self) -> &'static str {
        match self {
            Language::English => "en",
            Language::Portuguese => "pt-BR",
        }
    }

    pub(crate) fn decimal_comma(self) -> bool {
        self == Language::Portuguese
    }
}

impl FromStr for Language {
    type Err = String;

    /// Reads `en`, `pt-BR` and what is near to them: `pt`, `pt_BR`, `en-US`.
    fn from_str(tag: &str) -> Result<Self, String> {
        match tag.to_lowercase().split(['-', '_']).next() {
            Some("en") => Ok(Language::English),
            Some("pt") => Ok(Language::Portuguese),
            _ => Err("expected en or pt-BR".into()),
        }
    }
}

macro_rules! phrases {
    ($($name:ident: $en:literal, $pt:literal;)*) => {
        /// A phrase of the chain.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Phrase { $($name),* }

        impl Phrase {
            #[cfg(test)]
            pub const ALL: &[Phrase] = &[$(Phrase::$name),*];

            /// The phrase as the catalogue has it.
            pub fn words(self, language: Language) -> &'static str {
                match (self, language) {
                    $((Phrase::$name, Language::English) => $en, (Phrase::$name, Language::Portuguese) => $pt,)*
                }
            }
        }
    };
}

phrases! {
    // What meets, at a glance.
    TitleBodies1: "Two bodies meet on a line", "Dois corpos se chocam sobre uma reta";
    TitleBodies2: "Two bodies meet in the plane", "Dois corpos se chocam no plano";
    TitleBodies3: "Two bodies meet in space", "Dois corpos se chocam no espaço";
    TitleWall1: "A body meets a wall, on a line", "Um corpo se choca com uma parede, sobre uma reta";
    TitleWall2: "A body meets a wall, in the plane", "Um corpo se choca com uma parede, no plano";
    TitleWall3: "A body meets a wall, in space", "Um corpo se choca com uma parede, no espaço";
    HeadMass: "mass (kg)", "massa (kg)";
    HeadBefore: "velocity before (m/s)", "velocidade antes (m/s)";
    HeadAfter: "after (m/s)", "depois (m/s)";
    HeadSpin: "spin (rad/s)",
        "vel. angular (rad/s)";
    HeadRadius: "radius (m)", "raio (m)";
    HeadSpinBefore: "spin before (rad/s)", "vel. angular antes (rad/s)";
    HeadSpinAfter: "spin after (rad/s)", "vel. angular depois (rad/s)";
    Body1: "body 1", "corpo 1";
    Body2: "body 2", "corpo 2";
    Wall: "wall", "parede";
    Given: "Coefficient of restitution $e$ = {e}; no friction.", "Coeficiente de restituição $e$ = {e}; sem atrito.";
    GivenNormal: "Line of centres $n$ = {n}, from the first to the second; coefficient of restitution $e$ = {e}; no friction.",
        "Linha dos centros $n$ = {n}, do primeiro para o segundo; coeficiente de restituição $e$ = {e}; sem atrito.";
    Story: "They approach at {u}, exchange the impulse $J$ = {J} and part at {w}. The kinetic energy lost is {Q}.",
        "Aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. A energia cinética perdida é {Q}.";
    StoryElastic: "They approach at {u}, exchange the impulse $J$ = {J} and part at {w}. No kinetic energy is lost.",
        "Aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. Não se perde energia cinética.";
    StoryAlong: "Along the line of centres they approach at {u}, exchange the impulse $J$ = {J} and part at {w}. The kinetic energy lost is {Q}.",
        "Ao longo da linha dos centros aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. A energia cinética perdida é {Q}.";
    StoryAlongElastic: "Along the line of centres they approach at {u}, exchange the impulse $J$ = {J} and part at {w}. No kinetic energy is lost.",
        "Ao longo da linha dos centros aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. Não se perde energia cinética.";
    GivenRough: "Line of centres $n$ = {n}, from the first to the second; coefficient of restitution $e$ = {e}, of friction $μ$ = {f}, tangential restitution $et$ = {t}.",
        "Linha dos centros $n$ = {n}, do primeiro para o segundo; coeficiente de restituição $e$ = {e}, de atrito $μ$ = {f}, restituição tangencial $et$ = {t}.";
    StorySticks: "Along the line of centres they approach at {u}, exchange the impulse $J$ = {J} and part at {w}. Across it the surfaces slip at {s} and stick: friction gives {T}. The kinetic energy lost is {Q}: {q} to the normal impulse and {g} to friction.",
        "Ao longo da linha dos centros aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. Perpendicularmente a ela as superfícies deslizam a {s} e aderem: o atrito dá {T}. A energia cinética perdida é {Q}: {q} pelo impulso normal e {g} pelo atrito.";
    StorySuperball: "Along the line of centres they approach at {u}, exchange the impulse $J$ = {J} and part at {w}. Across it the surfaces slip at {s} and stick: friction gives {T}, and the slip turns round. No kinetic energy is lost.",
        "Ao longo da linha dos centros aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. Perpendicularmente a ela as superfícies deslizam a {s} e aderem: o atrito dá {T}, e o deslizamento se inverte. Não se perde energia cinética.";
    StorySlips: "Along the line of centres they approach at {u}, exchange the impulse $J$ = {J} and part at {w}. Across it the surfaces slip at {s}, and slip to the end: friction gives all it can, {T}. The kinetic energy lost is {Q}: {q} to the normal impulse and {g} to friction.",
        "Ao longo da linha dos centros aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. Perpendicularmente a ela as superfícies deslizam a {s}, e deslizam até o fim: o atrito dá tudo o que pode, {T}. A energia cinética perdida é {Q}: {q} pelo impulso normal e {g} pelo atrito.";
    StoryNoSlip: "Along the line of centres they approach at {u}, exchange the impulse $J$ = {J} and part at {w}. The surfaces do not slip, so friction has nothing to do. The kinetic energy lost is {Q}.",
        "Ao longo da linha dos centros aproximam-se a {u}, trocam o impulso $J$ = {J} e afastam-se a {w}. As superfícies não deslizam, e o atrito nada tem a fazer. A energia cinética perdida é {Q}.";
    FrictionOnALine: "On a line the surfaces cannot slip, so the coefficient of friction, {f}, has nothing to act on.",
        "Sobre uma reta as superfícies não podem deslizar; o coeficiente de atrito, {f}, não tem sobre o que agir.";
    LawStronge: "Law: Stronge's, which follows Coulomb's friction through the impact and knows no tangential restitution. For balls it gives what the default law gives with $et = 0$.",
        "Lei: a de Stronge, que acompanha o atrito de Coulomb ao longo do choque e não conhece a restituição tangencial. Para bolas ela dá o mesmo que a lei padrão com $et = 0$.";
    LawNewton: "Law: the textbook's, with Newton's coefficient and Coulomb's friction; it knows no tangential restitution. For balls it gives what the default law gives with $et = 0$; for other bodies it can make energy out of nothing.",
        "Lei: a dos livros, com o coeficiente de Newton e o atrito de Coulomb; ela não conhece a restituição tangencial. Para bolas ela dá o mesmo que a lei padrão com $et = 0$; para outros corpos pode criar energia do nada.";
    HeadValue: "value", "valor";
    HeadOrigin: "where it comes from", "de onde vem";
    OriginPair: "the pair table: {A} and {B}", "tabela de pares: {A} e {B}";
    OriginBoth: "geometric mean of {a} ({A}) and {b} ({B})", "média geométrica de {a} ({A}) e {b} ({B})";
    OriginMean: "mean of {a} ({A}) and {b} ({B})", "média de {a} ({A}) e {b} ({B})";
    OriginOne: "material {A}", "material: {A}";
    OriginUnsaid: "no surface says otherwise", "nenhuma superfície diz outra coisa";
    OriginRest: "a contact that lasts, slower than rest_speed: plastic", "contato que dura, mais lento que rest_speed: plástico";
    OriginCurve: ", its curve at {u}", ", curva lida a {u}";
    StoryParting: "They do not approach each other, so there is no impact: both keep their velocities.",
        "Eles não se aproximam um do outro; não há choque, e ambos mantêm suas velocidades.";

    // 1
    Momentum: "Momentum, $p = m v$", "Quantidade de movimento (momento linear), $p = m v$";
    MomentumSays: "Mass times velocity characterises the state of a moving body. It is a vector, one number for each direction:",
        "Massa vezes velocidade caracteriza o estado de um corpo em movimento. É um vetor, um número para cada direção:";
    MomentumLine: "Mass times velocity characterises the state of a moving body. On a line it is one number with a sign:",
        "Massa vezes velocidade caracteriza o estado de um corpo em movimento. Sobre uma reta é um só número, com sinal:";
    ByComponents: "By components:", "Por componentes:";
    MomentumWall: "The wall has no such account: its mass is infinite, it takes any impulse and keeps its velocity.",
        "Para a parede não se faz essa conta: sua massa é infinita, ela recebe qualquer impulso e mantém sua velocidade.";

    // 2
    Force: "Newton's second law, $F = [dp/dt]$", "Segunda lei de Newton, $F = [dp/dt]$";
    ForceSays: "A force is the rate at which momentum changes. While the bodies touch, each pushes the other, and the two forces are equal and opposite (third law):",
        "A força é a taxa de variação da quantidade de movimento. Enquanto os corpos se tocam, um empurra o outro, e as duas forças são iguais e opostas (terceira lei):";
    ForceMean: "If the contact lasts $Δt$ = {t}, the mean force is the impulse of step 3 divided by that time:",
        "Se o contato dura $Δt$ = {t}, a força média é o impulso do passo 3 dividido por esse tempo:";
    ForceUnknown: "How strong it is depends on how long they touch, and that is hardly ever known. The next step does without.",
        "Sua intensidade depende de quanto dura o contato, o que quase nunca se sabe. O próximo passo não precisa disso.";

    // 3
    Impulse: "Linear impulse, the change of momentum", "Impulso, a variação da quantidade de movimento";
    ImpulseSays: "Add up the force over the whole contact, and the duration drops out:",
        "Some a força ao longo de todo o contato, e a duração deixa de importar:";
    ImpulseHere: "In this impact (steps 9 to 11 find the velocities after it):",
        "Neste choque (os passos 9 a 11 calculam as velocidades depois dele):";
    ImpulsePair: "What one loses the other gains: the impulse they exchange has the size $J$ = {J}.",
        "O que um perde o outro ganha: o impulso trocado tem módulo $J$ = {J}.";

    ImpulsePairRough: "What one loses the other gains: {J} along the line of centres ($J$) and, by friction, {T} across it.",
        "O que um perde o outro ganha: {J} ao longo da linha dos centros ($J$) e, pelo atrito, {T} perpendicularmente a ela.";

    // 4
    Conservation: "Conservation of momentum", "Conservação da quantidade de movimento";
    ConservationSays: "$F1 + F2 = 0$ and nothing pushes from outside, so $0 = [dP/dt]$: the total is the same before and after, in each component.",
        "$F1 + F2 = 0$ e nada empurra de fora, logo $0 = [dP/dt]$: o total é o mesmo antes e depois, em cada componente.";
    ConservationLine: "$F1 + F2 = 0$ and nothing pushes from outside, so $0 = [dP/dt]$: the total is the same before and after.",
        "$F1 + F2 = 0$ e nada empurra de fora, logo $0 = [dP/dt]$: o total é o mesmo antes e depois.";
    ConservationWall: "What holds or drives the wall pushes from outside, so the momentum of the body alone is not constant. What it loses goes into the wall:",
        "Aquilo que segura ou move a parede empurra de fora; por isso a quantidade de movimento do corpo sozinho não se conserva. O que ele perde vai para a parede:";

    // 5
    Kinds: "Elastic or inelastic?", "Choque elástico ou inelástico?";
    KindsSay: "Momentum is conserved in every impact between them. Kinetic energy need not be:",
        "A quantidade de movimento se conserva em todo choque entre eles. A energia cinética, nem sempre:";
    KindsWall: "Whether kinetic energy is conserved, seen from the wall, is another question; the materials decide:",
        "Se a energia cinética se conserva, vista da parede, é outra questão; os materiais decidem:";
    Elastic: "elastic: kinetic energy is conserved", "elástico: a energia cinética se conserva";
    Inelastic: "inelastic: part of it is lost, to heat, sound, deformation",
        "inelástico: parte dela se perde, em calor, som, deformação";
    Plastic: "perfectly inelastic (plastic): the bodies do not part again, as much is lost as can be",
        "perfeitamente inelástico (plástico): os corpos não se separam mais, e perde-se o máximo possível";

    // 6
    Along: "Along and across the line of centres", "Ao longo da linha dos centros e perpendicularmente a ela";
    AlongLine: "The force acts along the line through the centres, and here that is all there is. With $Fh$ for the impulse on body 2:",
        "A força age ao longo da reta que une os centros, e aqui não há outra direção. Com $Fh$ para o impulso sobre o corpo 2:";
    AlongSays: "Smooth bodies can push only along the line of centres $n$. The part of each velocity along it ($vp$) changes:",
        "Corpos lisos só podem se empurrar ao longo da linha dos centros $n$. A parte de cada velocidade ao longo dela ($vp$) muda:";
    AlongRough: "Along the line of centres $n$ the bodies push each other; across it friction drags, and that is a chapter of its own, after step 11. The part of each velocity along it ($vp$) changes:",
        "Ao longo da linha dos centros $n$ os corpos se empurram; perpendicularmente a ela o atrito arrasta, e isso é um capítulo à parte, depois do passo 11. A parte de cada velocidade ao longo dela ($vp$) muda:";
    AcrossRough2: "Across it the lecture has $0 = m1 (vn1' - vn1)$ and $0 = m2 (vn2' - vn2)$, since it leaves friction for later. Here friction acts, and these two are no longer zero.",
        "Perpendicularmente a ela a aula tem $0 = m1 (vn1' - vn1)$ e $0 = m2 (vn2' - vn2)$, pois deixa o atrito para depois. Aqui o atrito age, e as duas já não são nulas.";
    AcrossRough3: "Across it the lecture has $0 = m1 (vt1' - vt1)$ and $0 = m2 (vt2' - vt2)$, since it leaves friction for later. Here friction acts, and these two are no longer zero.",
        "Perpendicularmente a ela a aula tem $0 = m1 (vt1' - vt1)$ e $0 = m2 (vt2' - vt2)$, pois deixa o atrito para depois. Aqui o atrito age, e as duas já não são nulas.";
    AlongExchange: "Along it, what one gains the other loses:", "Ao longo dela, o que um ganha o outro perde:";
    AlongWall: "Along it the body takes the impulse; the wall goes on as it did:",
        "Ao longo dela o corpo recebe o impulso; a parede continua como antes:";
    AlongWallLine: "The body takes the impulse; the wall goes on as it did:", "O corpo recebe o impulso; a parede continua como antes:";
    Across2: "Across it no force acts, since there is no friction between the bodies yet: $0 = m1 (vn1' - vn1)$ and $0 = m2 (vn2' - vn2)$. Those parts stay:",
        "Perpendicularmente a ela nenhuma força age, pois ainda não há atrito entre os corpos: $0 = m1 (vn1' - vn1)$ e $0 = m2 (vn2' - vn2)$. Essas partes não mudam:";
    Across3: "Across it no force acts, since there is no friction between the bodies yet: $0 = m1 (vt1' - vt1)$ and $0 = m2 (vt2' - vt2)$. Those parts stay:",
        "Perpendicularmente a ela nenhuma força age, pois ainda não há atrito entre os corpos: $0 = m1 (vt1' - vt1)$ e $0 = m2 (vt2' - vt2)$. Essas partes não mudam:";
    SpinStays: "Without friction nothing turns the bodies either: their spins stay.",
        "Sem atrito nada faz os corpos girarem mais ou menos: suas velocidades angulares não mudam.";
    SpinEnergyUnknown: "The energy of the spins is left out, as the radii are not given.",
        "A energia de rotação não entra na conta, pois os raios não foram dados.";
    NoFriction: "Across that line, in y and in z, no force would act, since there is no friction between the bodies yet: $0 = m1 (vy1' - vy1)$ and $0 = m2 (vy2' - vy2)$, so those components stay.",
        "Perpendicularmente a essa reta, em y e em z, nenhuma força agiria, pois ainda não há atrito entre os corpos: $0 = m1 (vy1' - vy1)$ e $0 = m2 (vy2' - vy2)$; essas componentes não mudam.";

    // 7
    OneShort: "One equation too few", "Falta uma equação";
    OneShortSays: "Conservation is a single equation, and two velocities are unknown:",
        "A conservação é uma só equação, e há duas velocidades desconhecidas:";
    OneShortWall: "The wall's velocity is known; the body's is not, and the wall takes whatever impulse it gets. An equation is missing:",
        "A velocidade da parede é conhecida; a do corpo, não, e a parede recebe qualquer impulso. Falta uma equação:";
    Slip: "A slip of sign: for the elastic impact the lecture's slide first writes $v1 - v2 = v1' - v2'$. With that line nothing would happen at all, for $v1' = v1$ and $v2' = v2$ solve both equations. The next slide has it right: $v1 - v2 = -(v1' - v2')$. They part as fast as they approached, the other way round.",
        "Um deslize de sinal: para o choque elástico o slide da aula escreve primeiro $v1 - v2 = v1' - v2'$. Com essa linha nada aconteceria, pois $v1' = v1$ e $v2' = v2$ resolvem as duas equações. O slide seguinte está certo: $v1 - v2 = -(v1' - v2')$. Afastam-se tão depressa quanto se aproximaram, em sentido contrário.";
    SlipAlong: "A slip of sign: for the elastic impact the lecture's slide, whose x lies along the line of centres, first writes $vx1 - vx2 = vx1' - vx2'$. With that line nothing would happen at all, for the old velocities solve both equations. The next slide has it right: $vx1 - vx2 = -(vx1' - vx2')$. They part as fast as they approached, the other way round.",
        "Um deslize de sinal: para o choque elástico o slide da aula, cujo x está na linha dos centros, escreve primeiro $vx1 - vx2 = vx1' - vx2'$. Com essa linha nada aconteceria, pois as velocidades antigas resolvem as duas equações. O slide seguinte está certo: $vx1 - vx2 = -(vx1' - vx2')$. Afastam-se tão depressa quanto se aproximaram, em sentido contrário.";

    // 8
    Restitution: "The coefficient of restitution", "O coeficiente de restituição";
    RestitutionSays: "The second equation: they part $e$ times as fast as they approached.",
        "A segunda equação: afastam-se com $e$ vezes a velocidade com que se aproximaram.";
    RestitutionSpeeds: "In short $u' = e u$, with the speeds of approach and of departure",
        "Em resumo, $u' = e u$, com as velocidades de aproximação e de afastamento";
    RestitutionParting: "The second equation says that bodies that approach part $e$ times as fast. These do not approach ($u$ = {u}, along the line of centres), so it is not asked:",
        "A segunda equação diz que corpos que se aproximam afastam-se com $e$ vezes essa velocidade. Estes não se aproximam ($u$ = {u}, ao longo da linha dos centros), e ela não se aplica:";

    // 9
    Closed: "The closed forms", "As fórmulas fechadas";
    ClosedSays: "Two equations, two unknowns. Solved:", "Duas equações, duas incógnitas. A solução:";
    ClosedAlong: "Two equations, two unknowns. Solved, along the line of centres:",
        "Duas equações, duas incógnitas. A solução, ao longo da linha dos centros:";
    ClosedWall: "Solved, with an infinite mass for the wall:", "A solução, com massa infinita para a parede:";
    ClosedParting: "Solved for bodies that meet. These do not, and keep their velocities:",
        "A solução, para corpos que se chocam. Estes não se chocam e mantêm suas velocidades:";

    // 10
    Rotated: "The rotated frame", "O referencial girado";
    RotatedLine: "On a line there is nothing to rotate.", "Sobre uma reta não há o que girar.";
    RotatedSpace: "In the plane the lecture turns the axes by the angle of the line of centres. In space that takes two angles; the next step takes none.",
        "No plano, a aula gira os eixos pelo ângulo da linha dos centros. No espaço são precisos dois ângulos; o próximo passo não precisa de nenhum.";
    RotatedSays: "Turn the axes until the first lies along the line of centres:",
        "Gire os eixos até que o primeiro coincida com a linha dos centros:";
    RotatedEnter: "In the turned axes ($vp$ along the line of centres, $vn$ across it) the velocities are",
        "Nos eixos girados ($vp$ ao longo da linha dos centros, $vn$ perpendicular a ela) as velocidades são";
    RotatedBack: "Step 9 turns $vp$ into $vp'$, and $vn$ stays. Then rotate back:",
        "O passo 9 transforma $vp$ em $vp'$, e $vn$ não muda. Depois, gire de volta:";
    RotatedBackRough: "Step 9 turns $vp$ into $vp'$, and friction turns $vn$ into $vn'$ (its chapter follows step 11). Then rotate back:",
        "O passo 9 transforma $vp$ em $vp'$, e o atrito transforma $vn$ em $vn'$ (seu capítulo vem depois do passo 11). Depois, gire de volta:";
    RotatedBackParting: "Nothing changes, and rotating back gives the velocities they had:",
        "Nada muda, e girar de volta dá as velocidades que eles tinham:";

    // 11
    Projection: "Without trigonometry: project", "Sem trigonometria: projete";
    ProjectionSays: "Scalar products do the same. With any vector $d$ along the line of centres, of any length:",
        "Produtos escalares fazem o mesmo. Com qualquer vetor $d$ na direção da linha dos centros, de qualquer comprimento:";
    ProjectionEngine: "No angle, no square root; the same on a line, in the plane and in space; for a wall $1/m = 0$. This is what the engine runs.",
        "Sem ângulo, sem raiz quadrada; o mesmo na reta, no plano e no espaço; para uma parede, $1/m = 0$. É isto que o motor do Carom calcula.";
    ProjectionParting: "$r·d$ is not positive: they do not approach. The impulse is zero, and both keep their velocities. (This is what the engine runs.)",
        "$r·d$ não é positivo: eles não se aproximam. O impulso é nulo, e ambos mantêm suas velocidades. (É isto que o motor do Carom calcula.)";

    ProjectionRough: "No angle, no square root; for a wall $1/m = 0$. This is the impulse along the line of centres, and friction does not change it. What friction adds across that line comes next.",
        "Sem ângulo, sem raiz quadrada; para uma parede, $1/m = 0$. Este é o impulso ao longo da linha dos centros, e o atrito não o altera. O que o atrito acrescenta perpendicularmente a ela vem a seguir.";

    // Friction.
    Slipping: "Friction: how the surfaces slip", "Atrito: como as superfícies deslizam";
    SlippingSays2: "What counts is not how the centres move across the line of centres ($vn$) but how the surfaces do. A spin $ω$ (counter-clockwise) moves the contact point of the first body by $R1 ω1$, that of the second, on its other side, by $-R2 ω2$. The first surface slips over the second at $s$:",
        "O que conta não é como os centros se movem perpendicularmente à linha dos centros ($vn$), mas como se movem as superfícies. A velocidade angular $ω$ (anti-horária) move o ponto de contato do primeiro corpo com $R1 ω1$, e o do segundo, que fica do outro lado, com $-R2 ω2$. A primeira superfície desliza sobre a segunda a $s$:";
    SlippingSays3: "What counts is not how the centres move across the line of centres ($vt$) but how the surfaces do: a spin moves the contact point by $R Ω × n$, forwards on the first body, backwards on the second, where it lies on the other side; so both spins add, in $Σ$. The first surface slips over the second at $σ$:",
        "O que conta não é como os centros se movem perpendicularmente à linha dos centros ($vt$), mas como se movem as superfícies: a velocidade angular move o ponto de contato com $R Ω × n$, para a frente no primeiro corpo, para trás no segundo, onde ele fica do outro lado; por isso as duas se somam, em $Σ$. A primeira superfície desliza sobre a segunda a $σ$:";
    SlippingMass: "An impulse across that line moves a body and turns it as well, so it meets less resistance than one along it. With the moments of inertia $I = k m R^2$, the slip weighs $mt$:",
        "Um impulso perpendicular a essa linha move o corpo e também o faz girar; por isso encontra menos resistência que um impulso ao longo dela. Com os momentos de inércia $I = k m R^2$, o deslizamento pesa $mt$:";
    SlippingMassWall: "An impulse across that line moves the body and turns it as well, so it meets less resistance than one along it. With the moment of inertia $I = k m R^2$, the slip weighs $mt$:",
        "Um impulso perpendicular a essa linha move o corpo e também o faz girar; por isso encontra menos resistência que um impulso ao longo dela. Com o momento de inércia $I = k m R^2$, o deslizamento pesa $mt$:";
    Sticking: "Friction: stick or slip", "Atrito: aderir ou deslizar";
    StickingSays: "To stop the slip, and to give back $et$ times as much of it, would take the impulse $Js$; Coulomb's friction can give no more than $μ$ times the impulse that presses the surfaces together:",
        "Para parar o deslizamento e devolver $et$ vezes esse tanto seria preciso o impulso $Js$; o atrito de Coulomb não pode dar mais que $μ$ vezes o impulso que aperta as superfícies uma contra a outra:";
    Sticks: "they stick: the slip turns into $-et$ times itself", "aderem: o deslizamento vira $-et$ vezes ele mesmo";
    Slips: "they slip to the end: friction gives all it can", "deslizam até o fim: o atrito dá tudo o que pode";
    StickingGives: "So friction hands the second body, along the slip of the first over it,",
        "Assim, o atrito entrega ao segundo corpo, no sentido em que o primeiro desliza sobre ele,";
    Cone: "Together with $J$ the impulse leans by {a} from the line of centres. Coulomb's cone of friction has the half-angle $arctan(μ)$ = {b}: the impulse lies inside it.",
        "Junto com $J$, o impulso se inclina {a} em relação à linha dos centros. O cone de atrito de Coulomb tem o semiângulo $arctan(μ)$ = {b}: o impulso está dentro dele.";
    ConeEdge: "Together with $J$ the impulse leans by {a} from the line of centres: as far as Coulomb's cone of friction, of half-angle $arctan(μ)$ = {b}, lets it.",
        "Junto com $J$, o impulso se inclina {a} em relação à linha dos centros: tanto quanto deixa o cone de atrito de Coulomb, de semiângulo $arctan(μ)$ = {b}.";
    Turning: "Friction: the velocities and the spins", "Atrito: as velocidades e as velocidades angulares";
    TurningVelocities: "It changes the velocities across the line of centres:", "Ele muda as velocidades perpendiculares à linha dos centros:";
    TurningWhole: "With the impulse along the line of centres, $Fh = Fhn + Fht$, the velocities become",
        "Com o impulso ao longo da linha dos centros, $Fh = Fhn + Fht$, as velocidades passam a ser";
    TurningSpins: "and, acting at the surfaces, it turns both bodies the same way round:",
        "e, como age nas superfícies, faz os dois corpos girarem no mesmo sentido:";
    TurningSpinWall: "and, acting at the surface, it turns the body:", "e, como age na superfície, faz o corpo girar:";
    TurningStuck: "The slip that is left is $-et$ times the first one, as it must be:",
        "O deslizamento que resta é $-et$ vezes o inicial, como deve ser:";
    TurningSlipped: "The surfaces still slip the same way, but more slowly:", "As superfícies ainda deslizam no mesmo sentido, porém mais devagar:";

    // What comes out.
    Result: "Result", "Resultado";
    Before: "before", "antes";
    After: "after", "depois";
    Change: "change", "variação";
    HeadUnit: "unit", "unidade";
    LostSays: "Kinetic energy before and after. With the reduced mass $μ$ and the speed of approach $u$, what is lost is $Q$:",
        "Energia cinética antes e depois. Com a massa reduzida $μ$ e a velocidade de aproximação $u$, a energia perdida é $Q$:";
    LostSaysRough: "Kinetic energy before and after, the spins included. With the reduced mass $mn$ the normal impulse takes $Qn$, and friction takes $Qt$:",
        "Energia cinética antes e depois, incluída a de rotação. Com a massa reduzida $mn$, o impulso normal leva $Qn$, e o atrito leva $Qt$:";
    WorkSays: "The wall moves, and does the work {W} on the body.", "A parede se move e realiza o trabalho {W} sobre o corpo.";
    EnergyOfSpins: "$K$ includes $R$ = {R}, the energy of the spins.",
        "$K$ inclui $R$ = {R}, a energia de rotação.";
    Checks: "Checks", "Verificação";
    CheckMomentum: "momentum", "quantidade de movimento";
    CheckRestitution: "restitution", "restituição";
    CheckEnergy: "energy", "energia";
    Holds: "holds", "confere";
    Fails: "fails", "não confere";

    // Special cases.
    Cases: "Special cases that hold here", "Casos particulares que valem aqui";
    CaseParting: "Bodies that part (or only touch) exchange nothing.", "Corpos que se afastam (ou apenas se tocam) não trocam nada.";
    CaseExchange: "Equal masses and $e = 1$: they exchange their velocities.", "Massas iguais e $e = 1$: eles trocam de velocidade.";
    CaseExchangeAlong: "Equal masses and $e = 1$: they exchange the parts of their velocities along the line of centres.",
        "Massas iguais e $e = 1$: eles trocam as componentes das velocidades ao longo da linha dos centros.";
    CaseCommon: "$e = 0$: both go on with one velocity, {V}.", "$e = 0$: ambos seguem com uma só velocidade, {V}.";
    CaseCommonAlong: "$e = 0$: along the line of centres both go on with one velocity, {V}.",
        "$e = 0$: ao longo da linha dos centros ambos seguem com uma só velocidade, {V}.";
    CaseWall: "A wall at rest: the velocity along the line of centres turns round, times $e$.",
        "Parede em repouso: a velocidade ao longo da linha dos centros inverte o sentido e fica multiplicada por $e$.";
    CaseDriven: "A moving wall: what turns round, times $e$, is the velocity relative to it.",
        "Parede em movimento: o que inverte o sentido e fica multiplicado por $e$ é a velocidade relativa a ela.";
    CaseRightAngle: "Equal masses, $e = 1$, one at rest, an oblique impact: they part at a right angle, $v1'·v2' = 0$.",
        "Massas iguais, $e = 1$, um em repouso, choque oblíquo: afastam-se em ângulo reto, $v1'·v2' = 0$.";
    CaseRolls: "The surfaces stick and $et = 0$: they leave rolling over one another, without slip.",
        "As superfícies aderem e $et = 0$: saem rolando uma sobre a outra, sem deslizar.";
    CaseSuperball: "A superball: $e = 1$ and $et = 1$, and the surfaces stick. Approach and slip both turn round, and no energy is lost.",
        "Uma superbola: $e = 1$ e $et = 1$, e as superfícies aderem. A aproximação e o deslizamento se invertem, e não se perde energia.";
    CaseCentre: "The centre of mass keeps its velocity, {V}.", "O centro de massa mantém sua velocidade, {V}.";
}

impl Phrase {
    /// The phrase as pieces, its places filled in.
    pub fn fill(self, language: Language, places: &[(&str, Inline)]) -> Vec<Inline> {
        let mut pieces = Vec::new();
        for (k, piece) in self.words(language).split('$').enumerate() {
            if k % 2 == 1 {
                pieces.push(Inline::Formula(relations(piece)));
                continue;
            }
            let mut rest = piece;
            while let Some((words, (name, after))) =
                rest.split_once('{').and_then(|(w, r)| Some((w, r.split_once('}')?)))
            {
                pieces.push(Inline::Words(words.into()));
                let place = places.iter().find(|p| p.0 == name).map(|p| p.1.clone());
                pieces.push(place.unwrap_or_else(|| Inline::Words(name.into())));
                rest = after;
            }
            pieces.push(Inline::Words(rest.into()));
        }
        pieces.retain(|p| !matches!(p, Inline::Words(w) if w.is_empty()));
        for piece in &mut pieces {
            // A letter and its value stay on one line.
            if matches!(piece, Inline::Words(w) if w == " = ") {
                *piece = Inline::Words("\u{a0}=\u{a0}".into());
            }
        }
        pieces
    }
}

/// Formulas with the relations between them: `v1 - v2 = -(v1' - v2')`. What cannot be read is left out; the tests read all.
pub(crate) fn relations(source: &str) -> Vec<(String, Formula)> {
    let mut parts = Vec::new();
    let mut relation = "";
    let mut rest = source;
    loop {
        let end = rest.find(['=', '<', '>', '≤', '≈']);
        let side = &rest[..end.unwrap_or(rest.len())];
        let formula = Formula::parse(side);
        debug_assert!(formula.is_some(), "not a formula: {side}");
        if let Some(formula) = formula {
            parts.push((relation.to_string(), formula));
        }
        let Some(end) = end else { return parts };
        let length = rest[end..].chars().next().map_or(1, char::len_utf8);
        relation = &rest[end..end + length];
        rest = &rest[end + length..];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The formulas and the places of a phrase, in order of their spelling.
    fn holes(phrase: &str) -> (Vec<&str>, Vec<&str>) {
        let mut formulas: Vec<&str> = phrase.split('$').skip(1).step_by(2).collect();
        let mut places: Vec<&str> = phrase.split('{').skip(1).filter_map(|p| p.split('}').next()).collect();
        formulas.sort_unstable();
        places.sort_unstable();
        (formulas, places)
    }

    #[test]
    fn both_languages_say_the_same() {
        // One table holds both, so no key can be missing; a phrase that was only copied, or that lost a formula, can.
        for &phrase in Phrase::ALL {
            let [en, pt] = Language::ALL.map(|l| phrase.words(l));
            assert!(!en.is_empty() && !pt.is_empty());
            assert_eq!(holes(en), holes(pt), "{phrase:?}");
            assert_ne!(en, pt, "{phrase:?} is not translated");
        }
    }

    #[test]
    fn every_formula_in_the_words_is_read() {
        for &phrase in Phrase::ALL {
            for language in Language::ALL {
                for source in holes(phrase.words(language)).0 {
                    let sides = source.split(['=', '<', '>', '≤', '≈']).count();
                    assert_eq!(relations(source).len(), sides, "{phrase:?}: {source}");
                }
            }
        }
    }

    #[test]
    fn places_are_filled() {
        let filled = Phrase::Given.fill(Language::English, &[("e", Inline::Words("0.5".into()))]);
        assert_eq!(filled.len(), 5);
        assert_eq!(filled[3], Inline::Words("0.5".into()));
    }

    #[test]
    fn tags() {
        assert_eq!("pt-BR".parse(), Ok(Language::Portuguese));
        assert_eq!("PT_br".parse(), Ok(Language::Portuguese));
        assert_eq!("en".parse(), Ok(Language::English));
        assert!("de".parse::<Language>().is_err());
    }
}
