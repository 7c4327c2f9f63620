"""What students answer in chapter 05; see answers.py for the form of this file."""

# %% before
import rospy

from course_pkg import join
from course_pkg.srv import geometry, geometryResponse

node = join("chapter_05")

# %% 05.1 after
node.serve("/getGeometry", geometry, handle_geometry)

# %% 05.1 right: a response made by keyword
def handle_geometry(request):
    area = request.width * request.length
    return geometryResponse(area=area, volume=area * request.height)

# %% 05.1 right: a tuple
def handle_geometry(request):
    return request.width * request.length, request.width * request.length * request.height

# %% 05.1 right: attributes of an empty response
def handle_geometry(request):
    response = geometryResponse()
    response.area = request.length * request.width
    response.volume = response.area * request.height
    return response

# %% 05.1 wrong: adds instead of multiplying | hint: That is width + length
def handle_geometry(request):
    return request.width + request.length, request.width + request.length + request.height

# %% 05.1 wrong: takes the front for the floor | hint: That is width times height
def handle_geometry(request):
    area = request.width * request.height
    return area, area * request.length

# %% 05.1 wrong: swaps area and volume | hint: The response has area first, then volume
def handle_geometry(request):
    area = request.width * request.length
    return area * request.height, area

# %% 05.1 wrong: prints and returns nothing | hint: The handler reached its end without a return
def handle_geometry(request):
    area = request.width * request.length
    print(area, area * request.height)

# %% 05.1 wrong: fills in the area only | hint: The field volume was never given a value
def handle_geometry(request):
    return geometryResponse(area=request.width * request.length)

# %% 05.1 wrong: returns one number | hint: it has not one value for each field
def handle_geometry(request):
    return request.width * request.length * request.height

# %% 05.1 wrong: never returns | hint: The call has not come back
def handle_geometry(request):
    while True:
        rospy.sleep(0.1)
