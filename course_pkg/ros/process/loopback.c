/* Preloaded into the programs of a graph on this computer: nodes in C++ listen on 127.0.0.1 only.
 *
 * If ROS_HOSTNAME is localhost, rospy and the rest of roscpp bind to 127.0.0.1. The XML-RPC server of roscpp
 * still binds to 0.0.0.0, so another computer could reach the node. This library replaces the one function
 * that does so, XmlRpc::XmlRpcSocket::bind(int, int), and nothing in programs that do not use it. The name
 * below is the one that C++ compilers give this function.
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
