"""The checks of chapter 05: the student's servers, called from outside."""

from course_pkg.examiner import Exam, part


@part(
    "05.1",
    points=2,
    goal="Answer /getGeometry with the area and the volume of a box.",
    needs=["handle_geometry"],
)
def area_and_volume(exam: Exam) -> None:
    """Three boxes of three different sides each."""
    get_geometry = exam.service("/getGeometry", "course_pkg/geometry")
    for _ in range(3):
        length, width, height = exam.draw.numbers(3, 0.5, 9.0)
        response = get_geometry(length=length, width=width, height=height)
        exam.expect(
            "area is width times length",
            expected=width * length,
            seen=response.area,
            near=1e-3,
            hints={
                0.0: "The field area was never given a value: a field that is left out is 0.",
                width + length: "That is width + length. An area is a product.",
                width * height: "That is width times height, the front. The floor is width times length.",
                length * height: "That is length times height, a side. The floor is width times length.",
                width * length * height: "That is the volume. The response has area first, then volume.",
            },
        )
        exam.expect(
            "volume is area times height",
            expected=width * length * height,
            seen=response.volume,
            near=1e-3,
            hints={
                0.0: "The field volume was never given a value: a field that is left out is 0.",
                width + length + height: "That is the sum of the sides. A volume is their product.",
                width * length + height: "That is area + height. A volume is a product.",
                width * length: "That is the area once more: multiply it by the height.",
            },
        )
