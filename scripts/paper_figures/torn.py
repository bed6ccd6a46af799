"""Figure 10 of Kang et al. 2022, drawn by `draw_cut`, and below it a sponge that tears."""
from matplotlib import pyplot

from paper_figures.drawing import ASPECT, BLUE, DPI, GREEN, RED, blend_body, frame, show_pale_image

PIECES = (GREEN, BLUE)
WORDS = ("(e) pulled", "just torn", "apart")
TITLE_PX = 30


def around_tear(states):
    """The last state before the body tears, the first one after it, and the last of all."""
    torn = next(number for number, state in enumerate(states) if state.revision > 0)
    return states[torn - 1], states[torn], states[-1]


def figure_10(picture, moments):
    """The picture of `draw_cut`, and a row with the torn body over the camera's images, each piece in its colour."""
    rows, columns = picture.shape[:2]
    strip = columns / len(moments) * ASPECT + TITLE_PX
    height = rows + strip
    figure = pyplot.figure(figsize=(columns / DPI, height / DPI), dpi=DPI)
    above = figure.add_axes([0, strip / height, 1, rows / height])
    above.imshow(picture)
    above.set_axis_off()
    for column, (moment, words) in enumerate(zip(moments, WORDS)):
        axis = figure.add_axes([column / len(moments), 0, 0.99 / len(moments), 1 - (rows + TITLE_PX) / height])
        axis.set_axis_off()
        frame(axis, moment.camera, [each.surface[0] for each in moments], words)
        show_pale_image(axis, moment.image)
        pieces = moment.state.triangle_pieces
        colors = [RED if is_cut else PIECES[piece % len(PIECES)]
                  for is_cut, piece in zip(moment.state.cut_triangles, pieces)]
        blend_body(axis, moment.camera, *moment.surface, colors, 0.5)
    return figure
