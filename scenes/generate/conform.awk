# conform.awk: a scene of scenes/conform as a scene of Mitsuba 3; conform.sh calls it.
# Tokens of the file lie in word[1..n]; a directive's parameters in value["rgb Kd", i], their number in count["rgb Kd"].
# m is the current transform, 3 rows of 4, by which points of a shape go to the world.
{
    sub(/#.*/, "")
    gsub(/\[/, " [ "); gsub(/\]/, " ] ")
    while (match($0, /"[^"]*"|[^ \t"]+/)) {
        word[++n] = substr($0, RSTART, RLENGTH)
        $0 = substr($0, RSTART + RLENGTH)
    }
}
function bare(s) { gsub(/"/, "", s); return s }
function number(k) { return word[k] + 0 }
# The parameters from word k on; returns the place after them.
function parameters(k,    name, i) {
    split("", value); split("", count)
    while (k <= n && word[k] ~ /^"/) {
        name = bare(word[k++])
        sub(/^(float|integer|string|bool|rgb|point|texture) /, "", name)
        i = 0
        if (word[k] == "[") { for (k++; k <= n && word[k] != "]"; k++) value[name, ++i] = bare(word[k]); k++ }
        else value[name, ++i] = bare(word[k++])
        count[name] = i
    }
    return k
}
function grey(kind, name, v) { return "<" kind " name=\"" name "\" value=\"" v "\"/>" }
function say(text) { out = out indent text "\n" }

# ---- transforms ----
function identity(    i, j) { for (i = 0; i < 3; i++) for (j = 0; j < 4; j++) m[i, j] = (i == j) }
function times(a, i,    j, k, r) { # m = m a
    for (i = 0; i < 3; i++) for (j = 0; j < 4; j++) {
        r[i, j] = (j == 3 ? m[i, 3] : 0)
        for (k = 0; k < 3; k++) r[i, j] += m[i, k] * a[k, j]
    }
    for (k in r) m[k] = r[k]
}
function plain(a,    i, j) { for (i = 0; i < 3; i++) for (j = 0; j < 4; j++) a[i, j] = (i == j) }
function rotation(angle, x, y, z,    a, c, s, l) {
    l = sqrt(x * x + y * y + z * z); x /= l; y /= l; z /= l
    c = cos(angle * atan2(0, -1) / 180); s = sin(angle * atan2(0, -1) / 180)
    plain(a)
    a[0, 0] = x * x + (1 - x * x) * c; a[0, 1] = x * y * (1 - c) - z * s; a[0, 2] = x * z * (1 - c) + y * s
    a[1, 0] = x * y * (1 - c) + z * s; a[1, 1] = y * y + (1 - y * y) * c; a[1, 2] = y * z * (1 - c) - x * s
    a[2, 0] = x * z * (1 - c) - y * s; a[2, 1] = y * z * (1 - c) + x * s; a[2, 2] = z * z + (1 - z * z) * c
    times(a)
}
function minor(i, j) { return m[1, i] * m[2, j] - m[1, j] * m[2, i] }
function mirrors() { # is the determinant negative?
    return m[0, 0] * minor(1, 2) - m[0, 1] * minor(0, 2) + m[0, 2] * minor(0, 1) < 0
}
function matrix(a,    i, j, s) {
    for (i = 0; i < 3; i++) for (j = 0; j < 4; j++) s = s sprintf("%.9g ", a[i, j])
    return "<transform name=\"to_world\"><matrix value=\"" s "0 0 0 1\"/></transform>"
}
# ---- what a shape carries ----
function word_of(name, v) { return "<string name=\"" name "\" value=\"" v "\"/>" }
function two_sides(bsdf) { return "<bsdf type=\"twosided\">" bsdf "</bsdf>" }
function plugin(type, inner) { return "<bsdf type=\"" type "\">" inner "</bsdf>" }
function material(type,    inner) {
    if (type == "matte") return two_sides(plugin("diffuse", grey("rgb", "reflectance", value["Kd", 1])))
    if (type == "mirror") {
        inner = word_of("material", "none") grey("rgb", "specular_reflectance", value["Kr", 1])
        return two_sides(plugin("conductor", inner))
    }
    if (type == "glass") {
        inner = grey("float", "int_ior", value["eta", 1]) grey("float", "ext_ior", 1)
        if (!(("uroughness", 1) in value)) return plugin("dielectric", inner)
        inner = grey("float", "alpha", value["uroughness", 1]) inner
        return plugin("roughdielectric", word_of("distribution", "ggx") inner)
    }
    if (type == "metal") {
        inner = word_of("distribution", "ggx") grey("float", "alpha", value["roughness", 1])
        inner = inner grey("spectrum", "eta", value["eta", 1]) grey("spectrum", "k", value["k", 1])
        return two_sides(plugin("roughconductor", inner))
    }
    if (type == "mix") {
        inner = named[value["namedmaterial1", 1]] named[value["namedmaterial2", 1]]
        return plugin("blendbsdf", grey("float", "weight", 1 - value["amount", 1]) inner)
    }
}
function shape(type, inner) {
    say("<shape type=\"" type "\">" inner)
    say("    " bsdf)
    if (light != "") say("    <emitter type=\"area\">" grey("rgb", "radiance", light) "</emitter>")
    say("</shape>")
}
function quad(    p, a, i, j, k, swap) {
    for (k = 0; k < 4; k++) for (i = 0; i < 3; i++) {
        p[k, i] = m[i, 3]
        for (j = 0; j < 3; j++) p[k, i] += m[i, j] * value["P", 3 * k + j + 1]
    }
    swap = (mirrors() + reversed) % 2 # corners 1 and 3 are exchanged where the normal is
    for (i = 0; i < 3; i++) {
        a[i, swap] = (p[1, i] - p[0, i]) / 2
        a[i, 1 - swap] = (p[3, i] - p[0, i]) / 2
        a[i, 3] = (p[0, i] + p[2, i]) / 2
    }
    for (i = 0; i < 3; i++) {
        j = (i + 1) % 3
        k = (i + 2) % 3
        a[i, 2] = a[j, 0] * a[k, 1] - a[k, 0] * a[j, 1]
    }
    shape("rectangle", matrix(a))
}
function triple(kind, name, x, y, z) {
    return sprintf("<%s name=\"%s\" x=\"%.9g\" y=\"%.9g\" z=\"%.9g\"/>", kind, name, x, y, z)
}
function sphere(    radius) {
    radius = sqrt(m[0, 0] ^ 2 + m[1, 0] ^ 2 + m[2, 0] ^ 2) * value["radius", 1]
    shape("sphere", triple("point", "center", m[0, 3], m[1, 3], m[2, 3]) grey("float", "radius", radius) \
        (reversed ? "<boolean name=\"flip_normals\" value=\"true\"/>" : ""))
}
function disk(    a, i, j) {
    for (i in m) a[i] = m[i]
    for (i = 0; i < 3; i++) for (j = 0; j < 3; j++) a[i, j] *= value["radius", 1]
    shape("disk", matrix(a))
}
function say_emitter(type, inner) { say("<emitter type=\"" type "\">" inner "</emitter>") }
function emitter(type,    at) {
    if (type == "point") {
        at = triple("point", "position", value["from", 1], value["from", 2], value["from", 3])
        say_emitter("point", at grey("rgb", "intensity", value["I", 1]))
    }
    if (type == "distant") {
        at = triple("vector", "direction", value["to", 1] - value["from", 1], value["to", 2] - value["from", 2],
            value["to", 3] - value["from", 3])
        say_emitter("directional", at grey("rgb", "irradiance", value["L", 1]))
    }
    if (type == "infinite") say_emitter("constant", grey("rgb", "radiance", value["L", 1]))
}
function camera(type,    s, kind) {
    kind = type == "orthographic" ? type : ("lensradius", 1) in value ? "thinlens" : type
    s = type == "orthographic" ? value["screenwindow", 2] : 1
    say("<sensor type=\"" kind "\">")
    if (type != "orthographic") say("    " word_of("fov_axis", "smaller") grey("float", "fov", value["fov", 1]))
    if (kind == "thinlens")
        say("    " grey("float", "aperture_radius", value["lensradius", 1]) \
            grey("float", "focus_distance", value["focaldistance", 1]))
    say("    <transform name=\"to_world\"><scale x=\"" (-s) "\" y=\"" s "\"/>")
    say("        <lookat origin=\"" eye "\" target=\"" at "\" up=\"" up "\"/></transform>")
    say("    <sampler type=\"independent\">" grey("integer", "sample_count", "$spp") \
        grey("integer", "seed", "$seed") "</sampler>")
    say("    <film type=\"hdrfilm\">" grey("integer", "width", width) grey("integer", "height", height) crop)
    say("        " word_of("file_format", "pfm") word_of("component_format", "float32") filter "</film>")
    say("</sensor>")
}
function three(k) { return number(k) " " number(k + 1) " " number(k + 2) }
function save(    k) {
    top++
    for (k in m) stack[top, k] = m[k]
    kept[top] = bsdf; shining[top] = light; turned[top] = reversed
}
function restore(    k) {
    for (k in m) m[k] = stack[top, k]
    bsdf = kept[top]; light = shining[top]; reversed = turned[top]
    top--
}
END {
    identity()
    indent = "    "
    for (k = 1; k <= n;) {
        w = word[k++]
        if (w == "LookAt") { eye = three(k); at = three(k + 3); up = three(k + 6); k += 9 }
        else if (w == "Translate" || w == "Scale") {
            plain(a)
            for (i = 0; i < 3; i++) if (w == "Scale") a[i, i] = number(k + i); else a[i, 3] = number(k + i)
            k += 3; times(a)
        } else if (w == "Rotate") { rotation(number(k), number(k + 1), number(k + 2), number(k + 3)); k += 4 }
        else if (w == "AttributeBegin") save()
        else if (w == "AttributeEnd") restore()
        else if (w == "ReverseOrientation") reversed = 1 - reversed
        else if (w == "WorldBegin" || w == "WorldEnd") identity()
        else if (w == "ObjectBegin") { say("<shape type=\"shapegroup\" id=\"" bare(word[k++]) "\">"); save() }
        else if (w == "ObjectEnd") { restore(); say("</shape>") }
        else if (w == "ObjectInstance") {
            for (i in m) a[i] = m[i]
            say("<shape type=\"instance\"><ref id=\"" bare(word[k++]) "\"/>" matrix(a) "</shape>")
        } else {
            type = bare(word[k])
            k = parameters(k + 1)
            if (w == "Film") {
                width = value["xresolution", 1]
                height = value["yresolution", 1]
                if (("cropwindow", 1) in value)
                    crop = grey("integer", "crop_offset_x", width * value["cropwindow", 1]) \
                        grey("integer", "crop_offset_y", height * value["cropwindow", 3]) \
                        grey("integer", "crop_width", 32) grey("integer", "crop_height", 32)
            } else if (w == "PixelFilter")
                filter = "<rfilter type=\"" type "\">" (type == "gaussian" ? grey("float", "stddev", .5) : "") \
                    "</rfilter>"
            else if (w == "Integrator")
                say("<integrator type=\"$integrator\">" grey("integer", "max_depth", value["maxdepth", 1] + 1) \
                    "</integrator>")
            else if (w == "Camera") camera(type)
            else if (w == "Material") bsdf = material(type)
            else if (w == "MakeNamedMaterial") named[type] = material(value["type", 1])
            else if (w == "AreaLightSource") light = value["L", 1]
            else if (w == "LightSource") emitter(type)
            else if (w == "Shape" && type == "trianglemesh") quad()
            else if (w == "Shape" && type == "sphere") sphere()
            else if (w == "Shape") disk()
        }
    }
    print "<scene version=\"3.0.0\">"
    split("integrator path spp 256 seed 0", word, " ")
    for (i = 1; i < 6; i += 2) print "    <default name=\"" word[i] "\" value=\"" word[i + 1] "\"/>"
    printf "%s", out
    print "</scene>"
}
