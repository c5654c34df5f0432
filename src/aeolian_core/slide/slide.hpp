#pragma once

/// The room `slide`: snow that slides off and piles up.
///
/// It will hold the material point method and its surrogate after Frischholz (see the specification). Nothing
/// that the twin does today needs it, so there is no code here yet.
