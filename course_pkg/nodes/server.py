import rospy
from course_pkg.srv import geometry
def main():
    rospy.init_node("SERVER_NODE")
    rospy.Service("getGeometry", geometry, lambda r: (r.length*r.width, r.length*r.width*r.height))
    rospy.spin()
