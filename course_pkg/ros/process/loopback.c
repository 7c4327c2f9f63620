/* A library that makes C++ nodes listen only on 127.0.0.1; it is loaded with LD_PRELOAD.
 *
 * If ROS_HOSTNAME is localhost, rospy and most parts of roscpp bind to 127.0.0.1. But roscpp's XML-RPC server
 * still binds to 0.0.0.0, so another computer could connect to the node. This library replaces only the
 * function XmlRpc::XmlRpcSocket::bind(int, int), which binds that server. Programs without this function do
 * not change. NAME is the mangled name of the function, which C++ compilers create.
 */
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <dlfcn.h>
#include <netinet/in.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#define NAME _ZN6XmlRpc12XmlRpcSocket4bindEii
#define STRING(name) #name
#define STRING_OF(name) STRING(name)

bool NAME(int descriptor, int port)
{
  const char *host = getenv("ROS_HOSTNAME");
  if (host == NULL || strcmp(host, "localhost") != 0) {
    bool (*original)(int, int) = (bool (*)(int, int))dlsym(RTLD_NEXT, STRING_OF(NAME));
    return original != NULL && original(descriptor, port);
  }
  struct sockaddr_in local = {.sin_family = AF_INET, .sin_port = htons((uint16_t)port)};
  local.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return bind(descriptor, (const struct sockaddr *)&local, sizeof local) == 0;
}
