within HydraulicTestBench.Pump;
model PistonKinematicsFlow "Flow of a pump from the motion of each piston, thesis Eq. 3.23 to 3.47"
  extends Interfaces.PartialPumpFlow;
  constant Data.PumpGeometry known = Data.PumpGeometry() "Known geometry";
  parameter Types.Length D_p = known.D_p "Diameter of a piston";
  parameter Types.Angle phi_0 = known.phi_0 "Angle between the pistons' axes and the plane they turn in";
  parameter Types.Angle gamma = known.gamma "Pressure carry over angle";
  parameter Types.Length R = known.R "Radius of the port plate";
  final parameter Types.Area A_1 = Constants.pi/4*D_p^2 "Area of a piston";
  final parameter Types.Angle theta_AO = gamma - D_p/(2*R) "Where port A opens, Eq. 3.37";
  final parameter Types.Angle phi_O = alphaMAX*cos(theta_AO) "Largest angle of a piston while port A opens, Eq. 3.25";
  final parameter Types.Length r_0 = V_d_max/(N_p*A_1)/(sin(phi_O)/sin(phi_0 - phi_O) + sin(phi_O)/sin(phi_0 + phi_O))
    "Distance of the pistons' axes from the shaft's, Eq. 3.34";
  Types.Angle theta_n[N_p] "Angular position of each piston, Eq. 3.41";
  Types.Angle phi_n[N_p] "Tilt of each piston's joint, Eq. 3.25";
  Types.Length x_phi[N_p] "Position of each piston over its tilt, Eq. 3.31";
  Types.Length x_theta[N_p] "Position of each piston over the angle of the shaft";
  Types.Length x_p[N_p] "Position of each piston, Eq. 3.29";
  Types.Velocity x_pt[N_p] "Velocity of each piston, Eq. 3.31";
  Real u_A[N_p](each unit="1") "Opening to port A, Eq. 3.43; that to port B is the rest, Eq. 3.44";
equation
  for n in 1:N_p loop
    theta_n[n] = theta + (n - 1)*2*Constants.pi/N_p;
    phi_n[n] = alpha*cos(theta_n[n]);
    x_p[n] = r_0*sin(phi_n[n])/sin(phi_0 - phi_n[n]);
    x_phi[n] = r_0*sin(phi_0)/sin(phi_0 - phi_n[n])^2;
    x_theta[n] = -x_phi[n]*alpha*sin(theta_n[n]);
    x_pt[n] = x_theta[n]*omega + x_phi[n]*alpha_t*cos(theta_n[n]);
    u_A[n] = if sin(theta_n[n] - theta_AO) > 0 then 1 else 0;
  end for;
  QPA = -A_1*sum(u_A[n]*x_pt[n] for n in 1:N_p);
  QPB = -A_1*sum((1 - u_A[n])*x_pt[n] for n in 1:N_p);
  tau = -A_1*sum((u_A[n]*port_A.p + (1 - u_A[n])*port_B.p)*x_theta[n] for n in 1:N_p);
  annotation(Documentation(info="<html>
<p>Each piston follows the plane of the swash plate along its own tilted axis and is joined to port A for the half turn
from &theta;<sub>A,O</sub> to &theta;<sub>A,C</sub> = &theta;<sub>A,O</sub> + &pi;, to port B for the other. An event at
each change: 18 per revolution with 9 pistons.</p>
<p><b>Source:</b> thesis Eq. 3.23 to 3.47; the torque is the pistons' work over the angle. 2r<sub>0</sub>
sin&phi;<sub>0</sub>/(1 - cos 2(&phi;<sub>n</sub> - &phi;<sub>0</sub>)) of Eq. 3.31 is written
r<sub>0</sub> sin&phi;<sub>0</sub>/sin<sup>2</sup>(&phi;<sub>0</sub> - &phi;<sub>n</sub>). The openings hold for any
&gamma;, also below D<sub>p</sub>/2R, where the intervals of Eq. 3.43 and 3.44 would have to be changed.</p>
<p><b>Valid:</b> speed and angle of either sign. The mean is Eq. 3.48 exactly at the largest angle, and less
at others: by 0.2 percent at 14.3 degrees, 1.8 at 7.5 and 2.3 near zero.</p>
<p><b>Leaves out:</b> pressure inside the pistons and its change at the ports: openings are either open or closed. The
work of the pistons on a swash plate that moves is taken from nobody; its actuator does not feel the pistons.</p>
</html>"));
end PistonKinematicsFlow;
